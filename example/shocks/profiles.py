#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""profiles.py RESULTS PICTURE: the runs of this scene over their exact solutions (those of test/verification/shocks.py)."""
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "test/verification"))
from hugoniot import elastic, shocked
from shocks import last_fields, sedov_profile, sod_density


class Folder:
    def __init__(self, directory):
        self.directory = pathlib.Path(directory)


def radial(axes, results, title, exact, reach):
    x, _, density, _ = last_fields(Folder(results))
    radius = numpy.hypot(x[:, 0], x[:, 1])
    r = numpy.linspace(0.002, reach, 2000)
    axes.plot(r, exact(r), color="#B65D5D", lw=1.2, label="exact")
    inside = radius < reach
    axes.plot(radius[inside], density[inside], ".", ms=1.5, color="#4C78A8", label="every cell")
    axes.set(title=title, xlabel="r [m]", ylabel="density [kg/m³]", xlim=(0.0, reach))


def plate(axes, results):
    law = {"eos": "mie-gruneisen", "density": 2703.0, "sound_speed": 5240.0, "slope": 1.40, "gruneisen": 1.97,
           "shear_modulus": 27.6e9}
    hel = elastic(law, 0.29e9)
    (stress, _, _, _), speed = shocked(law, 200.0, 2.0 / 3.0 * 0.29e9, hel)
    with open(pathlib.Path(results) / "probes.csv", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["name"] == "far"]
    time = [1e6 * float(row["time"]) for row in rows]
    axes.plot(time, [1e-9 * (float(row["pressure"]) + 2.0 / 3.0 * float(row["von_mises"])) for row in rows], color="#4C78A8",
              lw=1.0, label="probe 5 mm from the interface")
    arrive = [5.0e-3 / (hel[0] / (law["density"] * hel[2]) - 200.0), 5.0e-3 / (speed - 200.0)]
    axes.step([0.0, 1e6 * arrive[0], 1e6 * arrive[1], 1.3], [0.0, 1e-9 * hel[0], 1e-9 * stress, 1e-9 * stress],
              where="post", color="#B65D5D", lw=1.2, label="exact", zorder=0)
    axes.set(title="plates of 6061-T6 at 400 m/s", xlabel="t [µs]", ylabel="stress [GPa]", xlim=(0.6, 1.3))


def main(results, picture):
    results = pathlib.Path(results)
    figure, axes = plt.subplots(2, 3, figsize=(13.0, 6.6), constrained_layout=True)
    x, _, density, _ = last_fields(Folder(results / "sod"))
    fine = numpy.linspace(0.0, 1.0, 4000)
    axes[0, 0].plot(fine, sod_density(fine, 0.2), color="#B65D5D", lw=1.2, label="exact")
    axes[0, 0].plot(x[:, 0], density, ".", ms=3, color="#4C78A8", label="200 cells")
    axes[0, 0].set(title="Sod, t = 0.2 s, two fields in contact", xlabel="x [m]", ylabel="density [kg/m³]")
    radial(axes[0, 1], results / "noh", "Noh, t = 0.6 s, 100 x 100", lambda r: numpy.where(r < 0.2, 16.0, 1.0 + 0.6 / r), 0.4)
    radius, shape, _ = sedov_profile()
    radial(axes[1, 0], results / "sedov", "Sedov, t = 1 s, 120 x 120",
           lambda r: numpy.where(r < 1.0, 6.0 * numpy.interp(r, radius, shape), 1.0), 1.15)
    plate(axes[1, 1], results / "plate_impact")
    radial(axes[0, 2], results / "noh_spherical", "Noh, spherical, t = 0.6 s, 100 x 100",
           lambda r: numpy.where(r < 0.2, 64.0, (1.0 + 0.6 / r) ** 2), 0.4)
    axes[1, 2].remove()
    for a in axes.flat[:5]:
        a.legend(frameon=False, fontsize=8)
        a.grid(alpha=0.25)
    figure.savefig(picture, dpi=100)


main(*sys.argv[1:3])
