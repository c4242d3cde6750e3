#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a mixed pair costs by itself, apart from the cells around it.

cost.py HARMOS [--repeats N] runs deck.yaml on meshes of 20 to 160 cells a side, without fields and with a history row
at the end only, takes the least time of N runs of each, and fits

    time of a cycle = a + b * (pure and void cells) + c * mixed pairs

phase by phase, with no negative coefficient. Pure and void cells are in the same ratio on all meshes (one to five): b is
their mean. What goes with the interfaces is in c (cells that change their class, pure cells that intersect since a
neighbour is mixed), what goes with the corners, whose number does not change, in a.
"""
import argparse
import csv
import itertools
import json
import pathlib
import subprocess
import tempfile

import numpy

HERE = pathlib.Path(__file__).resolve().parent
PHASES = ("lagrange", "constrain", "remap", "reconstruct")
NAMES = ("a cycle", "another cell", "a mixed pair")


def run(harmos, cells, cycles, folder, every):
    subprocess.run(
        [harmos, "run", HERE / "deck.yaml", "--set", f"mesh/x/cells={cells}", "--set", f"mesh/y/cells={cells}",
         "--set", f"run/max_cycles={cycles}", "--set", f"output/history/every_cycles={every}",
         "--set", "output/fields/every_time=0", "--output", folder / "run", "--force"],
        check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return json.loads((folder / "run" / "summary.json").read_text())["phases"]


def counts(folder, cells):
    """Pure and void cells and mixed pairs of a mean cycle; a mixed cell is taken to hold one and a half pairs."""
    with open(folder / "run" / "history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))[:-1]
    mixed = numpy.mean([float(row["pairs_mixed"]) for row in rows])
    return cells * cells - mixed / 1.5, mixed


def fit(matrix, values):
    """Least squares of relative misfits over non-negative coefficients: the best of all subsets."""
    scaled, best = matrix / values[:, None], None
    for size in range(1, matrix.shape[1] + 1):
        for chosen in itertools.combinations(range(matrix.shape[1]), size):
            part, *_ = numpy.linalg.lstsq(scaled[:, chosen], numpy.ones(len(values)), rcond=None)
            misfit = numpy.linalg.norm(scaled[:, chosen] @ part - 1.0)
            if part.min() >= 0.0 and (best is None or misfit < best[0]):
                coefficients = numpy.zeros(matrix.shape[1])
                coefficients[list(chosen)] = part
                best = misfit, coefficients
    return best


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("harmos")
    parser.add_argument("--repeats", type=int, default=5)
    arguments = parser.parse_args()
    sizes = {20: 240, 28: 240, 40: 240, 56: 160, 80: 120, 112: 80, 160: 60}  # cycles by cells a side
    rows, times = [], {phase: [] for phase in PHASES}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for cells, cycles in sizes.items():
            run(arguments.harmos, cells, cycles, folder, 1)
            rows.append((1.0,) + counts(folder, cells))
            runs = [run(arguments.harmos, cells, cycles, folder, 1000000) for _ in range(arguments.repeats)]
            for phase in PHASES:
                times[phase].append(1e6 * min(phases[phase] for phases in runs) / cycles)
            total = sum(times[phase][-1] for phase in PHASES)
            print(f"{cells:4d} x {cells:<4d} mixed pairs {rows[-1][2]:6.0f}  {total:8.0f} us a cycle  "
                  f"{total / rows[-1][2]:6.2f} us a mixed pair, all charged to it")
    matrix, sums = numpy.array(rows), numpy.zeros(len(NAMES))
    print(f"{'microseconds':14s}" + "".join(f"{name:>14s}" for name in NAMES) + f"{'misfit':>10s}")
    for phase in PHASES:
        values = numpy.array(times[phase])
        misfit, coefficients = fit(matrix, values)
        sums += coefficients
        print(f"{phase:14s}" + "".join(f"{c:14.3f}" for c in coefficients)
              + f"{misfit / numpy.sqrt(len(values)):10.3f}")
    print(f"{'together':14s}" + "".join(f"{c:14.3f}" for c in sums))


if __name__ == "__main__":
    main()
