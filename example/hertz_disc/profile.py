#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""profile.py RESULTS PICTURE: force over approach, and pressure under the contact, over Hertz's (as in test/verification/hertz_disc.py)."""
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "test/verification"))
from hertz_disc import SPEED, contact_force, force_at, full_cells, half_width, stress_below


class Folder:
    def __init__(self, directory):
        self.directory = pathlib.Path(directory)


def main(results, picture):
    time, force, _ = contact_force(Folder(results))
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.0, 4.0), constrained_layout=True)
    travel = [SPEED * t for t in time]
    left.plot([1e3 * d for d in travel], [1e-6 * f for f in force], color="#4C78A8", lw=0.8, label="every cycle")
    left.plot([1e3 * d for d in travel[::20]], [1e-6 * force_at(d) for d in travel[::20]], color="#B65D5D", lw=1.4, label="Hertz")
    left.set(title="force", xlabel="approach of the platen [mm]", ylabel="F [MN/m]")

    x, y, stress = full_cells(Folder(results))
    a, top, final = half_width(force[-1]), SPEED * time[-1], force[-1]
    fine = numpy.linspace(0.0, 2.0, 300)
    right.plot(fine, [1e-9 * stress_below(q * a, 0.0, final) for q in fine], color="#A0A0A0", lw=1.0, ls="--", label="Hertz, at the platen")
    for colour, row in zip(("#1F4E79", "#C8571B", "#3B7D3A"), numpy.unique(numpy.round(y, 9))[[1, 3, 7]]):
        here = numpy.isclose(y, row)
        right.plot(fine, [1e-9 * stress_below(q * a, row - top, final) for q in fine], color=colour, lw=1.2)
        right.plot(x[here] / a, 1e-9 * stress[here], "o", ms=3.5, color=colour, label=f"{(row - top) / a:.2f} a below: cells, Hertz (line)")
    right.set(title="pressure on planes along the platen", xlabel="x / a", ylabel="-σ_yy [GPa]", xlim=(0.0, 2.0))
    for axes in (left, right):
        axes.legend(frameon=False, fontsize=8)
        axes.grid(alpha=0.25)
    figure.savefig(picture, dpi=100)


main(*sys.argv[1:3])
