#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""profile.py RESULTS PICTURE: both wedges at the end, the plastic one with its slip lines, and the forces over the exact ones (as in test/verification/wedge.py)."""
import pathlib
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy
from matplotlib.collections import PolyCollection

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "test/verification"))
from harness import read_columns
from wedge import GAP, SPEED, forces, plastic_force, slip_lines, water_force

CELL = {"plastic": 0.0025, "water": 0.01}
EXACT = {"plastic": plastic_force, "water": water_force}


def draw_bodies(axes, results, value, label, limits):
    """The polygons of what is deformed, coloured by value(pairs) within limits, and the outline of the wedge."""
    with h5py.File(sorted(results.glob("fields_*.h5"))[-1]) as file:
        pairs = file["pairs"]
        ends, body, vertices = pairs["polygon_end"][()], pairs["material"][()], pairs["vertex"][()]
        shade = value(pairs)
    polygons = numpy.split(vertices, ends[:-1])
    soft = [i for i in range(len(body)) if body[i] == body.min()]
    drawn = PolyCollection([polygons[i] for i in soft], array=shade[soft], cmap="viridis", lw=0.0, antialiased=False, clim=limits)
    axes.add_collection(drawn)
    axes.add_collection(PolyCollection([polygons[i] for i in range(len(body)) if body[i] != body.min()], facecolor="#B8B8B8", lw=0.0, antialiased=False))
    axes.figure.colorbar(drawn, ax=axes, label=label, shrink=0.8)
    axes.set(aspect="equal", xlabel="x [m]", ylabel="y [m]")


def draw_slip_lines(axes, depth, surface, theta=numpy.pi / 4.0):
    """Edges of the region that flows: along the wedge, the lip, and the last slip line, an arc about the lip's edge between two straight ends."""
    ratio, fan = slip_lines(theta)
    length = ratio * depth
    lip = numpy.array([length * numpy.sin(theta), length * numpy.cos(theta) - depth])
    end = numpy.array([lip[0] + length * numpy.cos(theta - fan), 0.0])
    directions = numpy.linspace(-theta - numpy.pi / 4.0, -theta - numpy.pi / 4.0 + fan, 40)  # from the lip's edge into the block
    arc = lip + length / numpy.sqrt(2.0) * numpy.stack([numpy.cos(directions), numpy.sin(directions)], axis=1)
    line = numpy.vstack([[0.0, -depth], arc, end, lip, [0.0, -depth]])
    axes.plot(line[:, 0], line[:, 1] + surface, color="#D1495B", lw=1.2, ls="--", label="slip lines (exact)")
    axes.legend(frameon=False, fontsize=8, loc="upper right")


def main(results, picture):
    folder = {name: pathlib.Path(results) / name for name in SPEED}
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(15.0, 4.2), constrained_layout=True)
    draw_bodies(left, folder["plastic"], lambda pairs: numpy.linalg.norm(pairs["velocity"][()], axis=1), "speed [m/s]", (0.0, 6.0))
    draw_bodies(middle, folder["water"], lambda pairs: 1e-3 * pairs["pressure"][()], "pressure [kPa]", (0.0, 400.0))
    for name, colour in zip(SPEED, ("#4C78A8", "#C8571B")):
        history = read_columns(folder[name] / "history.csv")
        if name == "plastic":
            draw_slip_lines(left, SPEED[name] * history["time"][-1] - GAP, 0.2533)
        depth, force, step = numpy.array(forces(folder[name], history, SPEED[name])).T
        edges = numpy.arange(1.0, depth[-1] / CELL[name], 0.5) * CELL[name]
        place = numpy.digitize(depth, edges)
        ratio = [(force * step)[place == i].sum() / sum(EXACT[name](d) * s for d, s in zip(depth[place == i], step[place == i]))
                 for i in range(1, len(edges))]
        right.plot(0.5 * (edges[1:] + edges[:-1]) / CELL[name], ratio, "o-", ms=2.5, lw=0.8, color=colour, label=f"{name}: means over half a cell")
    left.set(title="wedge into a plastic block", xlim=(0.0, 0.25), ylim=(0.15, 0.35))
    middle.set(title="wedge into water", xlim=(0.0, 0.75), ylim=(-0.35, 0.25))
    right.axhline(1.0, color="#606060", lw=0.8)
    right.set(title="force over the exact one", xlabel="depth of the tip [cells]", ylim=(0.5, 1.5))
    right.legend(frameon=False, fontsize=8)
    right.grid(alpha=0.25)
    figure.savefig(picture, dpi=100)


main(*sys.argv[1:3])
