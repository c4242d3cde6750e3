# SPDX-License-Identifier: BSD-3-Clause
"""Accuracy against cost: what an error costs in processor time, for each kinematics and order of the remap.

accuracy_cost.py [--output FOLDER] [--quick]: four scenes with exact answers on a row of meshes; writes accuracy-cost.md and
accuracy_cost.png. --quick: the two coarsest meshes of each (a check that all of it runs).
"""
import argparse
import os
import pathlib
from math import log

import numpy

from harness import ROOT, clean, harmos
from shocks import l1, last_fields, sod_density, surface_radii
from sliding_block import DECK as BLOCK, SQUEEZE, momentum_error, settings as sliding

QUIET = {"output/fields/every_time": 0.0, "output/history/every_cycles": 10, "output/history/at_end": "true"}
ORDERS = {f"xfem, {name} order": {"numerics/remap/order": order} for order, name in ((1, "first"), (2, "second"), (3, "third"))}
SINGLE = {"single, second order": {"kinematics": "single"}}
FILLED = {"xfem, second order, stress over filled regions": {"numerics/cut_cell_stress": "filled regions"}}
LAGRANGIAN = {"lagrangian": {"kinematics": "lagrangian"}}
LINES = {"xfem, first order": "C0s-", "xfem, second order": "C1o-", "xfem, third order": "C2^-", "single, second order": "C3v--",
         "lagrangian": "kD:", "xfem, second order, stress over filled regions": "C4P-"}


def sod(cells, keys):
    """L1 of the density of Sod's tube at 0.2 s [kg/m^3]."""
    more = {}
    if keys.get("kinematics") == "lagrangian":
        for name, center, state in (("left", 0.25, (1.0, 1.0)), ("right", 0.75, (0.125, 0.1))):
            more[f"bodies/{name}"] = (f"{{material: gas, shape: rectangle, center: [{center}, {0.5 / cells!r}], size: [0.5, {1.0 / cells!r}], "
                                      f"cells: [{cells // 2}, 1], density: {state[0]}, pressure: {state[1]}}}")
    r = harmos("shocks/sod.yaml", {"mesh/x/cells": cells, "mesh/y/to": 1.0 / cells, **QUIET, **keys, **more})
    x, area, density, _ = last_fields(r)
    return r, l1(density, sod_density(x[:, 0], 0.2), area)


def bars(cells, keys):
    """Relative error of the velocity with which a struck bar leaves; `cells` over each bar's length of 1 m."""
    speed, h = 5.0, 1.0 / cells
    more = {"mesh/x/cells": round(2.5 * cells), "mesh/y/to": h}
    for name, center, velocity in (("left", -0.5, speed), ("right", 0.5, -speed)):
        fitted = keys.get("kinematics") == "lagrangian"
        place = (center if fitted else center + 0.3 * h, 0.5 * h)
        more[f"bodies/{name}"] = (f"{{material: steel, shape: rectangle, center: [{place[0]!r}, {place[1]!r}], size: [1.0, {h!r}], "
                                  f"velocity: [{velocity}, 0.0]" + (f", cells: [{cells}, 1]" if fitted else "") + "}")
    r = harmos("two_bars/deck.yaml", {**QUIET, **more, **keys})
    return r, abs(r.last("right.momentum_x") / r.last("right.mass") / speed - 1.0)


def block(cells, keys):
    """Change of the momentum along the channel over m V: squeezed by 1% of its modulus, at 22.5 degrees, `cells` over its height."""
    r = harmos(BLOCK, {**sliding(22.5, (0.31, 0.17), cells, SQUEEZE), **keys})
    return r, momentum_error(r, 22.5)


def verney(cells, keys):
    """Relative error of the outer radius at which the shell stops; `cells` over its thickness."""
    if keys.get("kinematics") == "lagrangian":
        r = harmos("verney/lagrangian.yaml", {"bodies/shell/cells": f"[{cells}, {6 * cells}]", **QUIET})
    else:
        across = round(5.2 * cells)
        r = harmos("verney/deck.yaml", {"mesh/x/cells": across, "mesh/y/cells": across, **QUIET, **keys})
    return r, abs(surface_radii(r)[1][0] / 0.072111 - 1.0)


SCENES = {
    "Sod's shock tube: L1 of the density [kg/m^3]": (sod, (100, 200, 400, 800, 1600), {**ORDERS, **LAGRANGIAN}),
    "Two bars: exit velocity, relative": (bars, (20, 40, 80, 160, 320), {**ORDERS, **SINGLE, **LAGRANGIAN}),
    "Squeezed sliding block: momentum over m V": (block, (8, 16, 32), {**ORDERS, **FILLED, **SINGLE}),
    "Verney's shell: outer radius, relative": (verney, (5, 10, 20), {**ORDERS, **FILLED, **LAGRANGIAN}),
}
INTRODUCTION = """# Accuracy against cost

Four scenes with exact answers, each on a row of meshes with every kinematics and order of the remap that it makes sense for. Time: of the processor for the whole run, set-up included, on one rank. Written by
`test/verification/accuracy_cost.py` (three minutes; AMD EPYC, family 25, one core of two, preset `native`, machine at rest; times of less than 0.1 s are mostly the program's start).

What it says:

- Sod: second order has 0.58 (100 cells) to 0.30 (1600) of first order's error for up to a quarter more time; third order 1 to 2% less again, for another quarter.
- Two bars: the order does not matter. The error is that of time stepping and viscosity ([why](../example/two_bars/README.md)).
- Squeezed block: `xfem` keeps the momentum to round-off, with any order and on any mesh, since the platens are rigid and their normals exact ([decision 0022](decisions/0022-rigid-surfaces-give-the-normal.md)); `single` misses all of it on every mesh.
- Verney: the exact answer is that of an incompressible, rigid-plastic shell. Body-fitted meshes tend to 6.5e-4 beyond it, and stress over filled regions ([decision 0012](decisions/0012-stress-of-cut-cells.md)) gives 4.8e-4, 6.0e-4 and 6.3e-4 on the three: measured against that it is right to 2e-4 on
  5 cells over the shell, at a tenth more time, where the default is off by 8e-4. Below 6.5e-4 errors make up for each other.
- Third order costs a quarter more in strips and twice as much around a shell; body-fitted blocks are two to three times cheaper while they survive.

![error against processor time](pictures/accuracy_cost.png)

"""


def measure(scene, cells, keys):
    r, error = SCENES[scene][0](cells, keys)
    result = {"error": error, "seconds": r.summary["cpu_seconds"], "cycles": r.summary["cycles"]}
    clean(r)
    return result


def table(scene, rows):
    """Rows of the scene's table; the order is that between the meshes of a row and the row before, of errors above round-off."""
    lines = [f"## {scene}", "", "| | cells | error | order | cycles | seconds | seconds times error |", "| --- | --- | --- | --- | --- | --- | --- |"]
    for name, found in rows.items():
        before = None
        for cells, one in found.items():
            order = f"{log(before[1] / one['error']) / log(cells / before[0]):.2f}" if before and one["error"] > 1e-12 else ""
            lines.append(f"| {name} | {cells} | {one['error']:.2e} | {order} | {one['cycles']:,} | {one['seconds']:.2f} | {one['seconds'] * one['error']:.1e} |")
            before = (cells, one["error"])
    return lines + [""]


def draw(results, picture):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(2, 2, figsize=(10.5, 7.6), constrained_layout=True)
    for axis, (scene, rows) in zip(axes.flat, results.items()):
        for name, found in rows.items():
            axis.loglog([one["seconds"] for one in found.values()], [one["error"] for one in found.values()], LINES[name], ms=5, lw=1.2, label=name)
            for cells, one in list(found.items())[:: max(1, len(found) - 1)]:
                axis.annotate(str(cells), (one["seconds"], one["error"]), textcoords="offset points", xytext=(4, 3), fontsize=6)
        axis.set(title=scene, xlabel="processor time [s]", ylabel="error")
        axis.title.set_fontsize(9)
        axis.grid(True, which="both", lw=0.2)
        axis.legend(fontsize=7)
    figure.savefig(picture, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "doc")
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    results = {}
    for scene, (_, meshes, methods) in SCENES.items():
        chosen = meshes[:2] if options.quick else meshes
        results[scene] = {name: {cells: measure(scene, cells, keys) for cells in chosen} for name, keys in methods.items()}
        print("\n".join(table(scene, results[scene])), flush=True)
    pictures = options.output / "pictures"
    pictures.mkdir(parents=True, exist_ok=True)
    draw(results, pictures / "accuracy_cost.png")
    lines = [line for scene, rows in results.items() for line in table(scene, rows)]
    (options.output / "accuracy-cost.md").write_text(INTRODUCTION + "\n".join(lines).rstrip() + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
