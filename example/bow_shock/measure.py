#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Where the bow shock stands before the body and the pressure at its nose: measure.py RESULTS [RESULTS ...]

Along the stagnation line the shock lies where the pressure has half of a normal shock's jump. Each number is the mean
over the outputs of the run's second half. Beside them: Billig's fit to experiments, J. Spacecraft Rockets 4 (1967)
822-823, stand-off / R = 0.386 exp(4.67 / M^2) of a cylinder, 0.143 exp(3.24 / M^2) of a sphere, and Rayleigh's pressure
behind a normal shock brought to rest. From the shock to the nose the total pressure p (1 + (g - 1) M^2 / 2)^(g / (g - 1))
and the total enthalpy e + p / rho + u^2 / 2 are constant: Rayleigh's pressure and that of the stream.
"""
import json
import math
import pathlib
import sys
from typing import NamedTuple

import h5py
import numpy as np

GAMMA, MACH, P1, RADIUS = 1.4, 3.0, 1.0e5, 0.02
ENTHALPY = GAMMA / (GAMMA - 1.0) * P1 / 1.2 + 0.5 * 1024.7**2  # total, of the stream
LAYER = (0.2, 0.6)  # of the stand-off: behind the shock's cells and before the nose
STAND_OFF = {"planar": 0.386 * math.exp(4.67 / MACH**2), "axisymmetric": 0.143 * math.exp(3.24 / MACH**2)}
SHOCK = 1.0 + 2.0 * GAMMA / (GAMMA + 1.0) * (MACH**2 - 1.0)  # pressure ratio of a normal shock
STAGNATION = (((GAMMA + 1.0)**2 * MACH**2 / (4.0 * GAMMA * MACH**2 - 2.0 * (GAMMA - 1.0)))**(GAMMA / (GAMMA - 1.0)) *
              (1.0 - GAMMA + 2.0 * GAMMA * MACH**2) / (GAMMA + 1.0))


class BowShock(NamedTuple):
    """What a run shows."""

    geometry: str
    stand_off: float  # over the radius
    nose: float       # pressure over the stream's
    total_pressure: float  # of the layer, over Rayleigh's
    enthalpy: float   # of the layer, over the stream's


def stagnation_line(file, mesh, axisymmetric):
    """Places along the stagnation line; pressure, total pressure and total enthalpy of the air in the cells beside it."""
    nx, ny = int(mesh["x"]["cells"]), int(mesh["y"]["cells"])
    with h5py.File(file) as h5:
        air = h5["pairs/material"][:] == h5["materials"][()].decode().split().index("air")
        cell = h5["pairs/cell"][:].astype(int)[air]
        rows = [h5["pairs/" + name][:][air] for name in ("pressure", "density", "internal_energy")]
        rows.append(h5["pairs/velocity"][:][air, 1 if axisymmetric else 0])
    grid = np.full((4, nx * ny), np.nan)
    grid[:, cell] = rows
    grid = grid.reshape(4, ny, nx)
    pressure, density, energy, u = grid[:, :, 0] if axisymmetric else 0.5 * (grid[:, ny // 2 - 1] + grid[:, ny // 2])
    along = mesh["y"] if axisymmetric else mesh["x"]
    x = along["from"] + (along["to"] - along["from"]) * (np.arange(len(pressure)) + 0.5) / len(pressure)
    mach2 = u**2 * density / (GAMMA * pressure)
    total = pressure * (1.0 + 0.5 * (GAMMA - 1.0) * mach2)**(GAMMA / (GAMMA - 1.0))
    return x, pressure, total, energy + pressure / density + 0.5 * u**2


def measure(directory):
    """BowShock of a run."""
    directory = pathlib.Path(directory)
    deck = json.loads((directory / "summary.json").read_text())["deck"]
    geometry = deck["geometry"]
    files = sorted(directory.glob("fields_*.h5"))
    found = []
    for file in files[len(files) // 2:]:
        x, p, total, enthalpy = stagnation_line(file, deck["mesh"], geometry == "axisymmetric")
        half = 0.5 * (1.0 + SHOCK) * P1
        i = int(np.argmax(p > half))
        shock = x[i - 1] + (half - p[i - 1]) / (p[i] - p[i - 1]) * (x[i] - x[i - 1])
        stand_off = (-RADIUS - shock) / RADIUS
        whole = x < -RADIUS - 0.5 * (x[1] - x[0]) * (1.0 - 1e-9)  # cells before the nose
        part = (-RADIUS - x) / (stand_off * RADIUS)
        layer = (part > LAYER[0]) & (part < LAYER[1])
        found.append((stand_off, p[whole][-1] / P1, total[layer].mean() / (STAGNATION * P1), enthalpy[layer].mean() / ENTHALPY))
    return BowShock(geometry, *(float(value) for value in np.mean(found, axis=0)))


if __name__ == "__main__":
    for name in sys.argv[1:]:
        r = measure(name)
        print(f"{name}: stand-off / R {r.stand_off:.3f} (Billig {STAND_OFF[r.geometry]:.3f}), pressure at the nose / p1 {r.nose:.2f} "
              f"(Rayleigh {STAGNATION:.2f}); behind the shock total pressure {r.total_pressure:.3f} of Rayleigh's, "
              f"total enthalpy {r.enthalpy:.3f} of the stream's")
