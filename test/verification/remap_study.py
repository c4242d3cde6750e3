# SPDX-License-Identifier: BSD-3-Clause
"""Errors, bounds and cost of the remap alone, all schemes: tables.

remap_study.py [--finest N] [--output FOLDER]: writes remap-study.md. About five minutes on one core with the default.
"""
import argparse
import pathlib
import subprocess
import tempfile

from harness import EXAMPLE, HARMOS, read_columns

SCHEMES = {
    "swept, first": {"scheme": "swept", "order": 1},
    "swept": {"scheme": "swept"},
    "swept, not limited": {"scheme": "swept", "limiter": "none"},
    "intersection": {"scheme": "intersection"},
    "intersection, not limited": {"scheme": "intersection", "limiter": "none"},
    "interpolation": {"scheme": "interpolation"},
    "projection, lumped": {"scheme": "lumped projection"},
    "projection, consistent": {"scheme": "consistent projection"},
}
INTRODUCTION = """# The remap alone

One field remapped over moving meshes of the unit square by `harmos remap` (scene `example/remap`), without mechanics. Written by `test/verification/remap_study.py`; the quick part of it is `test/verification/remap.py`.

Second order is limited in the cycle's own schemes (swept, intersection) and is not in the comparators (interpolation, projections), unless its name says otherwise. Conservation: largest relative change of the sum of f V over all steps. Below, above: how far beyond the range of the start
f ever went. Time: of the processor in the remap, on a machine that others use too (half as much again either way); the cycle's schemes carry eight fields and momentum, the comparators one field. Five steps for each cell along a side.
"""
CASES = [("tensor", "sine"), ("smooth", "sine"), ("tensor", "shock"), ("smooth", "shock")]


def remap(deck, settings):
    with tempfile.TemporaryDirectory(prefix="harmos-") as directory:
        command = [HARMOS, "remap", str(EXAMPLE / "remap" / deck), "--output", directory, "--force"]
        for key, value in settings.items():
            command += ["--set", f"{key}={value}"]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0:
            return {"failed": done.stdout.strip().splitlines()[-1]}
        return read_columns(pathlib.Path(directory) / "remap.csv")


def numbers(values):
    return "[" + ", ".join(f"{v}.0" for v in values) + "]"


def table(title, deck, schemes, settings, cells):
    lines = [f"## {title}", "", "| scheme | cells | L1 | order | L2 | Linf | conservation | below | above | ns a cell and step |", "| --- " * 10 + "|"]
    for name, scheme in schemes.items():
        r = remap(deck, {**settings, **scheme, "cells": numbers(cells)})
        if "failed" in r:
            lines.append(f"| {name} | {r['failed']} |" + " |" * 8)
            continue
        for i, n in enumerate(r["cells"]):
            order = "" if i == 0 else f"{r['order_L1'][i]:.2f}"
            lines.append(f"| {name} | {n:.0f} | {r['L1'][i]:.2e} | {order} | {r['L2'][i]:.2e} | {r['Linf'][i]:.2e} | {r['conservation'][i]:.0e} | {max(r['below'][i], 0):.0e} | {max(r['above'][i], 0):.0e} | {r['cpu_ns_per_cell_step'][i]:.0f} |")
        print(lines[-1], flush=True)
    return lines + [""]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--finest", type=int, default=64, help="cells along a side, cyclic remapping")
    parser.add_argument("--output", default=".")
    options = parser.parse_args()
    cells = [n for n in (32, 64, 128) if n <= options.finest]
    lines = [INTRODUCTION]
    for motion, field in CASES:
        lines += table(f"Cyclic remapping: {motion} motion, {field}", "deck.yaml", SCHEMES, {"motion": motion, "field": field}, cells)
    own = {name: scheme for name, scheme in SCHEMES.items() if scheme["scheme"] in ("swept", "intersection")}
    own["intersection, range inside"] = {"scheme": "intersection", "limiter": "range inside"}
    own["intersection, first"] = {"scheme": "intersection", "order": 1}
    lines += table("One remap from a regular onto a random mesh, 2 + sine", "random.yaml", own, {}, [32, 64, 128, 256])
    path = pathlib.Path(options.output) / "remap-study.md"
    path.write_text("\n".join(lines))
    print(path)


main()
