#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Where the bow shock stands before the body and the pressure at its nose: measure.py RESULTS [RESULTS ...]

Along the stagnation line the shock lies where the pressure has half of a normal shock's jump. Each number is the mean
over the outputs of the run's second half. Beside them: Billig's fit to experiments, J. Spacecraft Rockets 4 (1967)
822-823, stand-off / R = 0.386 exp(4.67 / M^2) of a cylinder, 0.143 exp(3.24 / M^2) of a sphere, and Rayleigh's pressure
behind a normal shock brought to rest.
"""
import json
import math
import pathlib
import sys

import h5py
import numpy as np

GAMMA, MACH, P1, RADIUS = 1.4, 3.0, 1.0e5, 0.02
STAND_OFF = {"planar": 0.386 * math.exp(4.67 / MACH**2), "axisymmetric": 0.143 * math.exp(3.24 / MACH**2)}
SHOCK = 1.0 + 2.0 * GAMMA / (GAMMA + 1.0) * (MACH**2 - 1.0)  # pressure ratio of a normal shock
STAGNATION = (((GAMMA + 1.0)**2 * MACH**2 / (4.0 * GAMMA * MACH**2 - 2.0 * (GAMMA - 1.0)))**(GAMMA / (GAMMA - 1.0)) *
              (1.0 - GAMMA + 2.0 * GAMMA * MACH**2) / (GAMMA + 1.0))


def stagnation_line(file, mesh, axisymmetric):
    """Places along the stagnation line and the pressures of the cells beside it."""
    nx, ny = int(mesh["x"]["cells"]), int(mesh["y"]["cells"])
    with h5py.File(file) as h5:
        pressure = h5["cells/pressure"][:].reshape(ny, nx)
    along = mesh["y"] if axisymmetric else mesh["x"]
    n = ny if axisymmetric else nx
    x = along["from"] + (along["to"] - along["from"]) * (np.arange(n) + 0.5) / n
    return x, pressure[:, 0] if axisymmetric else 0.5 * (pressure[ny // 2 - 1] + pressure[ny // 2])


def measure(directory):
    """(geometry, stand-off / R, stagnation pressure / p1) of a run."""
    directory = pathlib.Path(directory)
    deck = json.loads((directory / "summary.json").read_text())["deck"]
    geometry = deck["geometry"]
    files = sorted(directory.glob("fields_*.h5"))
    stand_off, nose = [], []
    for file in files[len(files) // 2:]:
        x, p = stagnation_line(file, deck["mesh"], geometry == "axisymmetric")
        half = 0.5 * (1.0 + SHOCK) * P1
        i = int(np.argmax(p > half))
        shock = x[i - 1] + (half - p[i - 1]) / (p[i] - p[i - 1]) * (x[i] - x[i - 1])
        stand_off.append((-RADIUS - shock) / RADIUS)
        whole = x < -RADIUS - 0.5 * (x[1] - x[0]) * (1.0 - 1e-9)  # cells before the nose
        nose.append(p[whole][-1] / P1)
    return geometry, float(np.mean(stand_off)), float(np.mean(nose))


if __name__ == "__main__":
    for name in sys.argv[1:]:
        kind, d, p = measure(name)
        print(f"{name}: stand-off / R {d:.3f} (Billig {STAND_OFF[kind]:.3f}), pressure at the nose / p1 {p:.2f} "
              f"(Rayleigh {STAGNATION:.2f})")
