# SPDX-License-Identifier: BSD-3-Clause
"""Iterations of the multipliers' solver against their number: strips of 10 to 10,000 columns of cells; and over more cycles.

contact_iterations.py [--quick] [--output FOLDER]: writes contact-iterations.md.
contact_iterations.py --way WAY [--columns N ...] [--cycles N]: one of WAYS alone, printed.
"""
import argparse
import pathlib
from math import sqrt

from harness import ROOT, clean, harmos

COLUMNS = [10, 100, 1000, 10000]
SHORT, LONG = 20, 200  # cycles
# Placement and solver.
WAYS = {"midpoint": ("midpoint", "projected newton"), "mortar": ("mortar", "projected newton"), "gauss points": ("gauss points", "projected newton"),
        "segment ends": ("segment ends", "projected newton"), "vital vertices": ("vital vertices", "projected newton"),
        "conjugate gradients": ("midpoint", "conjugate gradients"), "row sums": ("midpoint", "row sums")}


def iterations_of_strip(columns, friction, way, cycles=SHORT):
    """Mean and largest iterations of some cycles: two blocks meet along an interface that crosses a strip of so many columns of cells
    at a small slope, under one pressure, one of them sliding on the other. Multipliers; iterations; cycles above 50; those that missed the tolerance."""
    placement, solver = WAYS[way]
    slope = 2.3 / columns
    n = (-slope / sqrt(1.0 + slope * slope), 1.0 / sqrt(1.0 + slope * slope))
    half = lambda sign: (f"{{material: metal, shape: half-plane, point: [{0.5 * columns!r}, 4.1], normal: [{-sign * n[0]!r}, {-sign * n[1]!r}], "
                         f"pressure: 0.001, velocity: [{sign * 1e-3 * n[1]!r}, {-sign * 1e-3 * n[0]!r}]}}")
    r = harmos(ROOT / "test/verification/decks/sliver.yaml", {
        "mesh/x": f"{{from: 0.0, to: {float(columns)!r}, cells: {columns}}}", "mesh/y": "{from: 0.0, to: 8.0, cells: 8}",
        "bodies/left": half(1.0), "bodies/right": half(-1.0), "run/max_cycles": cycles, "output/history/every_cycles": 1,
        "interactions": "{default: friction, coefficient: 0.2}" if friction else "{default: sliding}",
        "numerics/constraint/solver": solver, "numerics/constraint/placement": placement}, expect=None)
    assert r.status == 0, r.text
    found = {"multipliers": r.last("multipliers"), "mean": sum(r["iterations"][1:]) / len(r["iterations"][1:]), "most": max(r["iterations"]),
             "above_50": sum(i > 50 for i in r["iterations"]),
             "missed": r.summary["unconverged_cycles"]}
    clean(r)
    return found


def measure(columns, longest):
    """(way, friction, cycles, what was found)"""
    runs = [("midpoint", friction, SHORT, n) for friction in (False, True) for n in columns]
    if longest > SHORT:
        for way in ("midpoint", "mortar", "gauss points", "segment ends"):
            runs += [(way, friction, longest, n) for friction in (False, True) for n in (columns if way in ("midpoint", "mortar") else columns[:3])]
        runs += [("conjugate gradients", friction, SHORT, n) for friction, most in ((False, 3), (True, 2)) for n in columns[:most]]
    return [(way, friction, cycles, iterations_of_strip(n, friction, way, cycles)) for way, friction, cycles, n in runs]


def table(found):
    lines = ["| | cycles | multipliers (mortar: rows that share them) | mean iterations | most | cycles that missed 1e-8 |", "| --- " * 6 + "|"]
    for way, friction, cycles, f in found:
        name = ("friction 0.2" if friction else "sliding") + ("" if way == "midpoint" else ", " + way)
        lines.append(f"| {name} | {cycles} | {f['multipliers']:.0f} | {f['mean']:.1f} | {f['most']:.0f} | {f['missed']} |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--way", choices=WAYS)
    parser.add_argument("--columns", type=int, nargs="+", default=COLUMNS[:3])
    parser.add_argument("--cycles", type=int, default=LONG)
    parser.add_argument("--output", default=str(ROOT / "results/contact_iterations"))
    arguments = parser.parse_args()
    if arguments.way:
        print(table([(arguments.way, friction, arguments.cycles, iterations_of_strip(n, friction, arguments.way, arguments.cycles))
                     for friction in (False, True) for n in arguments.columns]))
        raise SystemExit
    folder = pathlib.Path(arguments.output)
    folder.mkdir(parents=True, exist_ok=True)
    text = table(measure(COLUMNS[:2] if arguments.quick else COLUMNS, SHORT if arguments.quick else LONG))
    (folder / "contact-iterations.md").write_text(text)
    print(text)
