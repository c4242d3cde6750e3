#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Length, radius and largest plastic strain of the copper rod against the mesh, one chart for all ways to compute it.

convergence.py HARMOS RESULTS [--planar] [--finest N] runs deck.yaml with 4, 8, ... N cells over the rod's radius: `xfem`
with each order of the remap, `xfem` and `single` on a rigid anvil instead of the wall, and `lagrangian`. --planar: half a plate of the same section instead of the rod. It writes
RESULTS/convergence.md and RESULTS/convergence.png. Runs that are complete are not run again. The slow ones (anvils,
lagrangian) stop at 16 cells, third order at 32.
"""
import argparse
import concurrent.futures
import csv
import os
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from completed_run import completedRun, summaryOf  # noqa: E402
RADIUS, ANVIL = 0.0032, 0.0064  # of the rod; depth of the anvil [m]
ANVIL_LAW = "{eos: rigid, density: 15600.0}"
ON_ANVIL = {"materials/anvil": ANVIL_LAW, "bodies/anvil": f"{{material: anvil, shape: rectangle, center: [0.0, {-0.5 * ANVIL}], "
                                                        f"size: [0.048, {ANVIL}]}}"}
# name: (deck keys, anvil below the rod, finest mesh, line)
SERIES = {
    "xfem, first order": ({"numerics/remap/order": 1}, False, 64, "C0s-"),
    "xfem, second order": ({}, False, 64, "C0o-"),
    "xfem, third order": ({"numerics/remap/order": 3}, False, 32, "C0^-"),
    "xfem on an anvil": (ON_ANVIL, True, 16, "C2o--"),
    "single on an anvil": ({**ON_ANVIL, "kinematics": "single"}, True, 16, "C3o--"),
    "lagrangian": ({"kinematics": "lagrangian"}, False, 16, "kD-"),
}


def settings(planar, keys, anvil, cells):
    below = round(ANVIL / RADIUS * cells) if anvil else 0
    across = 5 if planar else 3  # radii
    return {"geometry": "planar" if planar else "axisymmetric", "mesh/x/to": across * RADIUS, "mesh/x/cells": across * cells,
            "mesh/y/from": -RADIUS * below / cells,
            "mesh/y/cells": round(10.5 * cells) + below, "output/fields/every_time": 0.0, **keys}


def folder(results, name, cells):
    return results / f"{name.replace(',', '').replace(' ', '_')}_{cells}"


def run(harmos, results, planar, name, cells):
    keys, anvil, _, _ = SERIES[name]
    completedRun(harmos, HERE / "deck.yaml", folder(results, name, cells), settings(planar, keys, anvil, cells))


def measure(out):
    with open(out / "history.csv", newline="", encoding="utf-8") as file:
        last = list(csv.DictReader(file))[-1]
        return (1e3 * (float(last["rod.y_max"]) - float(last["rod.y_min"])), 1e3 * float(last["rod.x_max"]),
            float(last["rod.plastic_strain_max"]), summaryOf(out)["cycles"])


def meshes(name, finest):
    cells, chosen = 4, []
    while cells <= min(finest, SERIES[name][2]):
        chosen.append(cells)
        cells *= 2
    return chosen


def draw(results, finest, planar, picture):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    titles = ("length [mm]", "radius [mm]", "largest plastic strain")
    others = ((21.4, 21.7), (7.0, 7.2), (2.5, 3.3))
    figure, axes = plt.subplots(1, 3, figsize=(12.0, 4.2), constrained_layout=True)
    for quantity, (axis, title, span) in enumerate(zip(axes, titles, others)):
        if not planar:
            axis.axhspan(*span, color="#E8E8E8", lw=0.0, label="other codes")
        for name in SERIES:
            chosen = meshes(name, finest)
            axis.plot(chosen, [measure(folder(results, name, cells))[quantity] for cells in chosen], SERIES[name][3], ms=4,
                      lw=1.1, label=name)
        axis.set(title=title, xlabel="cells over the radius", xscale="log")
        ticks = meshes("xfem, first order", finest)
        axis.set_xticks(ticks, [str(tick) for tick in ticks])
        axis.minorticks_off()
    axes[2].legend(fontsize=7)
    figure.savefig(picture, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("harmos")
    parser.add_argument("results", type=pathlib.Path)
    parser.add_argument("--planar", action="store_true")
    parser.add_argument("--finest", type=int, default=32, help="cells over the radius")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="runs at a time")
    options = parser.parse_args()
    options.results.mkdir(parents=True, exist_ok=True)
    todo = [(name, cells) for name in SERIES for cells in meshes(name, options.finest)]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for finished in [pool.submit(run, options.harmos, options.results, options.planar, *one) for one in todo]:
            finished.result()
    lines = ["| | cells over the radius | length [mm] | radius [mm] | plastic strain | cycles |", "| --- | --- | --- | --- | --- | --- |"]
    for name, cells in todo:
        length, radius, strain, cycles = measure(folder(options.results, name, cells))
        lines.append(f"| {name} | {cells} | {length:.3f} | {radius:.3f} | {strain:.2f} | {cycles:,} |")
    (options.results / "convergence.md").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))
    draw(options.results, options.finest, options.planar, options.results / "convergence.png")


if __name__ == "__main__":
    try:
        main()
    except RuntimeError as error:
        sys.exit(f"convergence.py: {error}")
