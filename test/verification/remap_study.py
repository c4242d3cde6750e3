# SPDX-License-Identifier: BSD-3-Clause
"""Errors, bounds and cost of the remap alone, all schemes: tables and log-log plots.

remap_study.py [--finest N] [--resume] [--output FOLDER]: writes remap-study.md, remap.json, remap_resolution.png and
remap_time.png. About ten minutes on one core with the default. With --resume, what remap.json holds is not run again.
remap_study.py --time [--output FOLDER]: measures the times alone, about a minute, and keeps them in remap.json: for a quiet
machine; then --resume.
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import tempfile
from math import log2

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from harness import EXAMPLE, HARMOS, ROOT, read_columns

OWN = {
    "swept, first": {"scheme": "swept", "order": 1},
    "swept": {"scheme": "swept"},
    "swept, van leer": {"scheme": "swept", "limiter": "van leer"},
    "swept, not limited": {"scheme": "swept", "limiter": "none"},
    "swept, third": {"scheme": "swept", "order": 3},
    "swept, third, not limited": {"scheme": "swept", "order": 3, "limiter": "none"},
    "field intersection": {"scheme": "field intersection"},
    "intersection, first": {"scheme": "intersection", "order": 1},
    "intersection": {"scheme": "intersection"},
    "intersection, van leer": {"scheme": "intersection", "limiter": "van leer"},
    "intersection, not limited": {"scheme": "intersection", "limiter": "none"},
    "third": {"scheme": "intersection", "order": 3},
    "third, van leer": {"scheme": "intersection", "order": 3, "limiter": "van leer"},
    "third, not limited": {"scheme": "intersection", "order": 3, "limiter": "none"},
}
COMPARATORS = {
    "interpolation": {"scheme": "interpolation"},
    "projection, lumped": {"scheme": "lumped projection"},
    "projection, consistent": {"scheme": "consistent projection"},
}
CASES = {
    "Cyclic remapping: tensor motion, sine": ("deck.yaml", {"motion": "tensor", "field": "sine"}),
    "Cyclic remapping: smooth motion, sine": ("deck.yaml", {"motion": "smooth", "field": "sine"}),
    "Cyclic remapping: tensor motion, shock": ("deck.yaml", {"motion": "tensor", "field": "shock"}),
    "Cyclic remapping: smooth motion, shock": ("deck.yaml", {"motion": "smooth", "field": "shock"}),
    "One remap from a regular onto a random mesh, 2 + sine": ("random.yaml", {}),
    "Rings (axisymmetric, x the radius): tensor motion, sine": ("deck.yaml", {"geometry": "axisymmetric", "motion": "tensor", "field": "sine"}),
    "Rings (axisymmetric, x the radius): tensor motion, shock": ("deck.yaml", {"geometry": "axisymmetric", "motion": "tensor", "field": "shock"}),
}
DRAWN = ["swept, first", "swept", "swept, not limited", "swept, third", "intersection", "field intersection", "third", "third, not limited", "projection, consistent"]
# L1 of a peer (Portage) on the same meshes, fields and steps: limited (Barth & Jespersen), not limited
PEER = {
    "Cyclic remapping: tensor motion, sine": {"32": (2.08e-2, 1.27e-2), "64": (4.90e-3, 1.66e-3)},
    "Cyclic remapping: smooth motion, sine": {"32": (6.71e-3, 2.60e-3), "64": (1.66e-3, 3.43e-4)},
    "Cyclic remapping: tensor motion, shock": {"32": (4.00e-2, 4.72e-2), "64": (2.42e-2, None)},
    "Cyclic remapping: smooth motion, shock": {"32": (1.19e-2, 1.46e-2), "64": (8.05e-3, None)},
    "One remap from a regular onto a random mesh, 2 + sine": {"32": (2.19e-4, None), "64": (4.39e-5, None), "128": (1.03e-5, None), "256": (2.51e-6, None)},
}
# Of the random mesh, whose numbers the peer drew otherwise: its one mesh beside many of ours.
RANDOM_SIZES = [32, 64, 128, 256]
SEEDS = range(1, 21)
PEER_RANDOM = {
    "intersection, first": (3.74e-3, 1.66e-3, 8.19e-4, 4.01e-4),
    "intersection": (2.19e-4, 4.39e-5, 1.03e-5, 2.51e-6),
    "swept": (3.22e-4, 7.05e-5, 1.77e-5, 4.39e-6),
}
AGAINST = ["swept", "swept, third", "intersection", "field intersection", "third", "swept, not limited", "intersection, not limited", "third, not limited"]
SUMMARY = """Limited (`range inside`), second order where nothing is said. What is remapped, the means over overlays or swept areas, stays within the range of the donor and its neighbours. At the boundary of the mesh the neighbours are on one side: the sine is steepest there, and the exact mean of a cell that has become thinner lies beyond the values of all its donors. So the range
there goes on to the value of the cell opposite, mirrored, but not beyond the values at the mesh's rim: no value leaves the range of the start. The cycle sweeps wherever all is pure."""
INTRODUCTION = """# The remap alone

One field remapped over moving meshes of the unit square by `harmos remap` (scene `example/remap`), without mechanics. Written by `test/verification/remap_study.py`; the quick part of it is `test/verification/remap.py`.

Orders: first, second where nothing is said, third. Second and third order are limited (`range inside`) in the cycle's own schemes (swept, intersection, third) and are not in the comparators (interpolation, projections), unless the name says otherwise. Conservation: largest relative change of the sum of f V over all
steps. Below, above: how far beyond the range of the start f ever went. Five steps for each cell along a side.

![error against resolution](pictures/remap_resolution.png)

![error against time](pictures/remap_time.png)
"""


def schemes_of(title):
    if title.startswith("Rings"):  # planar: the field alone, comparators
        return {name: scheme for name, scheme in OWN.items() if not name.startswith("field")}
    return OWN if title.startswith("One") else {**OWN, **COMPARATORS}


def remap(deck, settings):
    with tempfile.TemporaryDirectory(prefix="harmos-") as directory:
        command = [HARMOS, "remap", str(EXAMPLE / "remap" / deck), "--output", directory, "--force"]
        for key, value in settings.items():
            command += ["--set", f"{key}={value}"]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0:
            raise SystemExit(f"{' '.join(command)}\n{done.stdout[-2000:]}")
        return {name: values[0] for name, values in read_columns(pathlib.Path(directory) / "remap.csv").items()}


def order(rows, n):
    """Slope of L1 against the coarser row."""
    coarser = rows.get(str(n // 2))
    return f"{log2(coarser['L1'] / rows[str(n)]['L1']):.2f}" if coarser else ""


def table(title, results, sizes):
    lines = [f"## {title}", "", "| scheme | cells | L1 | order | L2 | Linf | conservation | below | above |", "| --- " * 9 + "|"]
    for name in schemes_of(title):
        for n in sizes:
            r = results[name][str(n)]
            lines.append(f"| {name} | {n} | {r['L1']:.2e} | {order(results[name], n)} | {r['L2']:.2e} | {r['Linf']:.2e} | {r['conservation']:.0e} | {max(r['below'], 0):.0e} | {max(r['above'], 0):.0e} |")
    return lines + [""]


def measure_times(results, save):
    """Least of two runs, each of ten remaps from random to random mesh."""
    times = results.setdefault("time", {})
    for name, scheme in {**OWN, **COMPARATORS}.items():
        if name not in times:
            times[name] = min(remap("random.yaml", {**scheme, "cells": "[128.0]", "steps": 10})["cpu_ns_per_cell_step"] for _ in range(2))
            save()
    return times


def time_table(times):
    lines = ["## Time", "", "Of the processor in one remap from a random to a random mesh of 128 x 128 cells, ns a cell, one core, machine otherwise at rest (`remap_study.py --time`): the least of short runs. The cycle's schemes carry eight fields and momentum, `field intersection` and the comparators one field.",
             "", "| scheme | ns a cell | million cells a second |", "| --- " * 3 + "|"]
    return lines + [f"| {name} | {t:.0f} | {1e3 / t:.2f} |" for name, t in times.items()] + [""]


def peer_table(results):
    lines = ["## Against a peer", "", SUMMARY, "", "| case | cells | peer, limited | peer, not limited | " + " | ".join(AGAINST) + " |", "| --- " * (4 + len(AGAINST)) + "|"]
    for title, sizes in PEER.items():
        for n, (limited, free) in sizes.items():
            own = " | ".join(f"{results[title][name][n]['L1']:.2e}" for name in AGAINST)
            lines.append(f"| {title.replace('Cyclic remapping: ', '')} | {n} | {limited:.2e} | {'' if free is None else f'{free:.2e}'} | {own} |")
    return lines + [""]


def scatter_table(results, save):
    """L1 over meshes of other random numbers."""
    known = results.setdefault("seeds", {})
    lines = ["## Other random meshes", "", f"The same for {len(SEEDS)} meshes (`seed`): mean, standard deviation, least and largest L1, and how many are at most the peer's on its one mesh. First order with exact overlays has nothing to choose: it is the same scheme wherever it is written, and what differs are the random numbers.", "", "| scheme | cells | mean | deviation | least | largest | peer | at most the peer's |", "| --- " * 8 + "|"]
    for name, peers in PEER_RANDOM.items():
        for n, peer in zip(RANDOM_SIZES, peers):
            errors = known.setdefault(name, {}).setdefault(str(n), [])
            for seed in SEEDS[len(errors):]:
                errors.append(remap("random.yaml", {**OWN[name], "cells": f"[{n}.0]", "seed": seed})["L1"])
                save()
            lines.append(f"| {name} | {n} | {statistics.mean(errors):.3e} | {statistics.stdev(errors):.1e} | {min(errors):.3e} | {max(errors):.3e} | {peer:.2e} | {sum(e <= peer for e in errors)} of {len(errors)} |")
    return lines + [""]


def momentum_table(results, sizes):
    lines = ["## Momentum, angular momentum and kinetic energy", "", "The material's velocity is a vortex at rest on the walls, one more field of the same runs (sine). Momentum: largest change, less the walls' impulse, over sum m|v| (a bound of it). Angular momentum: largest relative change."
             " Kinetic energy: the part that is left at the end (`return_kinetic_defect` turns the rest into heat).",
             "Swept faces gain some in the tensor motion, whose steps reach Courant numbers of 1.2 (32) and 1.6 (64), far beyond a cycle's; with twice the steps (`steps_per_cell: 10`, Courant number 0.57) 0.992 is left at 32.", "", "| motion | scheme | cells | momentum | angular momentum | kinetic energy |", "| --- " * 6 + "|"]
    for title, (_, settings) in CASES.items():
        if settings.get("field") != "sine" or "geometry" in settings:
            continue
        for name in OWN:
            if name.startswith("field"):
                continue  # carries no momentum
            for n in sizes:
                r = results[title][name][str(n)]
                lines.append(f"| {settings['motion']} | {name} | {n} | {r['momentum']:.0e} | {r['angular_momentum']:.2e} | {r['kinetic_energy']:.6f} |")
    return lines + [""]


def draw(results, abscissa, label, path):
    """Error over abscissa(name of the scheme, row)."""
    figure, axes = plt.subplots(2, 3, figsize=(13, 8), constrained_layout=True)
    for axis, title in zip(axes.flat, [title for title in CASES if not title.startswith("Rings")]):
        for name, marker in zip(DRAWN, "xosv^D<>*+"):
            points = [(abscissa(name, r), r["L1"]) for n, r in sorted(results[title].get(name, {}).items(), key=lambda item: int(item[0]))]
            if points:
                axis.loglog(*zip(*points), marker + "-", label=name, linewidth=1, markersize=5)
        axis.set_title(title.replace("Cyclic remapping: ", ""), fontsize=9)
        axis.set_xlabel(label)
        axis.set_ylabel("L1")
        axis.grid(True, which="both", alpha=0.25)
        if label.startswith("cells"):
            sizes = sorted({int(n) for rows in results[title].values() for n in rows})
            axis.set_xticks(sizes, labels=[str(n) for n in sizes])
            axis.minorticks_off()
    handles, names = axes.flat[0].get_legend_handles_labels()
    axes.flat[5].axis("off")
    axes.flat[5].legend(handles, names, fontsize=9, loc="center")
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--finest", type=int, default=64, help="cells along a side, cyclic remapping")
    parser.add_argument("--output", default=str(ROOT / "results/remap_study"))
    parser.add_argument("--resume", action="store_true", help="keep what remap.json holds")
    parser.add_argument("--time", action="store_true", help="measure the times alone")
    options = parser.parse_args()
    folder = pathlib.Path(options.output)
    os.makedirs(folder, exist_ok=True)
    stored = folder / "remap.json"
    results = json.loads(stored.read_text()) if (options.resume or options.time) and stored.exists() else {}
    save = lambda: stored.write_text(json.dumps(results, indent=1))
    if options.time:
        results.pop("time", None)
    times = measure_times(results, save)
    if options.time:
        return
    cyclic = [n for n in (32, 64, 128) if n <= options.finest]
    lines = [INTRODUCTION]
    for title, (deck, settings) in CASES.items():
        sizes = RANDOM_SIZES if title.startswith("One") else cyclic
        for name, scheme in schemes_of(title).items():
            for n in sizes:
                known = results.setdefault(title, {}).setdefault(name, {})
                if str(n) not in known:
                    known[str(n)] = remap(deck, {**settings, **scheme, "cells": f"[{n}.0]"})
                    print(title, name, n, f"{known[str(n)]['L1']:.3e}", flush=True)
                    save()
        lines += table(title, results[title], sizes)
    if options.finest >= 64:
        lines += peer_table(results)
    lines += scatter_table(results, save)
    lines += momentum_table(results, cyclic) + time_table(times)
    (folder / "remap-study.md").write_text("\n".join(lines))
    draw(results, lambda name, r: r["cells"], "cells along a side", folder / "remap_resolution.png")
    draw(results, lambda name, r: 1e-9 * times[name] * r["cells"] ** 2 * r["steps"], "CPU time in the remap [s]", folder / "remap_time.png")
    print(folder / "remap-study.md")


main()
