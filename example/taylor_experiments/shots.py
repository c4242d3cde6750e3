#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Taylor rods of shots.csv beside what was measured.

shots.py HARMOS RESULTS [--cells N] [--friction MU] [--all] [--jobs N] runs deck.yaml for every shot (those with an outline;
--all: every one) and every strength law that example/materials has for its metal, with N cells over the rod's radius and
Coulomb's friction MU on the wall, writes RESULTS/shots.md and draws RESULTS/outlines.png.
A shot that has a summary with status `completed` is not run again.

The length is that between the rod's ends, the diameter the largest one: means over the last quarter of the run, when the
rod only rings.
"""
import argparse
import concurrent.futures
import csv
import math
import os
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from completed_run import completedRun  # noqa: E402
LAWS = {"johnson-cook": "#4C78A8", "johnson-cook-cylinders": "#3B7D3A", "steinberg-guinan": "#B65D5D"}


def lawFile(shot, law):
    return HERE.parent / "materials" / f"{shot['metal']}-{law}.yaml"


def lawsOf(shot):
    return [law for law in LAWS if lawFile(shot, law).exists()]


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def settings(shot, law, cells, friction=0.0):
    """Deck keys of a shot: cells of equal width and height, room for 1.5 diameters and one cell above the rod."""
    length, diameter = 1e-3 * float(shot["length"]), 1e-3 * float(shot["diameter"])
    width = 0.5 * diameter / cells
    extra = ", damage: none" if law == "johnson-cook" else ""
    rows_of_cells = math.ceil(length / width) + 2
    return {"title": f"Taylor rod {shot['shot']} m/s, {law}",
            "mesh/x": f"{{from: 0.0, to: {1.5 * diameter!r}, cells: {3 * cells}}}",
            "mesh/y": f"{{from: 0.0, to: {rows_of_cells * width!r}, cells: {rows_of_cells}}}",
            "materials/metal": f"{{from: ../materials/{lawFile(shot, law).name}{extra}}}",
            "bodies/rod/center": f"[0.0, {0.5 * length!r}]", "bodies/rod/size": f"[{diameter!r}, {length!r}]",
            "bodies/rod/velocity": f"[0.0, -{shot['speed']}.0]",
            "boundaries/bottom/friction": friction, "run/end_time": 1.0e-4 * length / 25.4e-3}


def folder(shot, law, options):
    friction = f"_friction_{options.friction}" if options.friction else ""
    return options.results / f"{shot['shot'].replace(' ', '_')}_{law}_{options.cells}{friction}"


def run(shot, law, options):
    completedRun(options.harmos, HERE / "deck.yaml", folder(shot, law, options),
                 settings(shot, law, options.cells, options.friction))


def measure(out):
    history = rows(out / "history.csv")
    end = float(history[-1]["time"])
    late = [row for row in history if float(row["time"]) > 0.75 * end]
    mean = lambda column: sum(float(row[column]) for row in late) / len(late)
    return (1e3 * (mean("rod.y_max") - mean("rod.y_min")), 2e3 * mean("rod.x_max"),
            float(history[-1]["rod.plastic_strain_max"]))


def departure(computed, measured):
    return f"{100.0 * (computed / float(measured) - 1.0):+.1f}%" if measured else ""


def table(shots, options):
    lines = ["| shot [m/s] | law | length [mm] | measured | | diameter [mm] | measured | | plastic strain |",
             "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"]
    for shot in shots:
        for law in lawsOf(shot):
            length, diameter, strain = measure(folder(shot, law, options))
            lines.append(f"| {shot['shot']} | {law} | {length:.2f} | {shot['final_length']} | "
                         f"{departure(length, shot['final_length'])} | {diameter:.2f} | {shot['final_diameter']} | "
                         f"{departure(diameter, shot['final_diameter'])} | {strain:.2f} |")
    return "\n".join(lines) + "\n"


def outline(out):
    """Free surface of the last output, in mm above the rod's lower end; both halves."""
    import h5py
    import numpy

    last = sorted(out.glob("fields_*.h5"))[-1]
    with h5py.File(last) as file:
        ends = 1e3 * file["interface/vertex"][:].reshape(-1, 2, 2)
        corners = 1e3 * file["pairs/vertex"][:]
    ends[:, :, 1] -= corners[:, 1].min()
    return numpy.concatenate([ends, ends * [-1.0, 1.0]])


def draw(shots, options, picture):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy
    from matplotlib.collections import LineCollection

    drawn = [shot for shot in shots if shot["outline"]]
    figure, axes = plt.subplots(1, len(drawn), figsize=(4.2 * len(drawn), 6.2), constrained_layout=True)
    for axis, shot in zip(numpy.atleast_1d(axes), drawn):
        points = numpy.loadtxt(HERE / "data" / shot["outline"], delimiter=",")
        for side in (1.0, -1.0):
            axis.fill_betweenx(points[1:-2, 1], 0.0, side * points[1:-2, 0], color="#DDDDDD", lw=0.0,
                               label="measured" if side > 0.0 else None)
            axis.plot(side * points[:, 0], points[:, 1], color="#777777", lw=0.8)
        for law in lawsOf(shot):
            colour = LAWS[law]
            axis.add_collection(LineCollection(outline(folder(shot, law, options)), colors=colour, lw=1.4))
            axis.plot([], [], color=colour, lw=1.4, label=law)
        start = 0.5 * float(shot["diameter"])
        axis.plot([-start, -start, start, start], [0.0, float(shot["length"]), float(shot["length"]), 0.0], ":", color="black",
                  lw=0.8, label="before")
        axis.set(title=f"{shot['shot']} m/s", xlabel="radius [mm]", ylabel="height [mm]", aspect="equal",
                 xlim=(-10.0, 10.0), ylim=(0.0, 1.03 * float(shot["length"])))
        axis.legend(loc="upper right", fontsize=7)
    figure.savefig(picture, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("harmos")
    parser.add_argument("results", type=pathlib.Path)
    parser.add_argument("--cells", type=int, default=8, help="over the rod's radius")
    parser.add_argument("--friction", type=float, default=0.0, help="Coulomb's coefficient on the wall")
    parser.add_argument("--all", action="store_true", help="every shot, not only those with an outline")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="runs at a time")
    options = parser.parse_args()
    shots = [shot for shot in rows(HERE / "shots.csv") if options.all or shot["outline"]]
    options.results.mkdir(parents=True, exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        runs = [pool.submit(run, shot, law, options) for shot in shots for law in lawsOf(shot)]
        for finished in runs:
            finished.result()
    text = table(shots, options)
    (options.results / "shots.md").write_text(text)
    print(text, end="")
    draw(shots, options, options.results / "outlines.png")


if __name__ == "__main__":
    try:
        main()
    except RuntimeError as error:
        sys.exit(f"shots.py: {error}")
