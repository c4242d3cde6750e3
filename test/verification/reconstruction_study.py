# SPDX-License-Identifier: BSD-3-Clause
"""Errors of the reconstruction methods against resolution and time: tables and pictures.

reconstruction_study.py [--finest N] [--only TITLE] [--resume] [--output FOLDER]: writes tables.md, tables.json,
error_resolution.png and error_time.png. About five minutes on one core with the default finest mesh, ten with 256.
With --resume, what tables.json of the folder holds already is not run again.
"""
import argparse
import json
import os
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from harness import ROOT, clean, harmos

METHODS = {
    "youngs": {"method": "youngs"},
    "least squares": {"method": "least squares"},
    "moment of fluid": {"method": "moment of fluid"},
    "moment of fluid, slivers below 0.1": {"method": "moment of fluid", "sliver": 0.1},
}
STILL = {"prescribed_velocity": "{field: translation, velocity: [0.0, 0.0]}", "bodies/disc/center": "[0.5, 0.5]", "bodies/disc/radius": 0.3, "run/end_time": 1.0}
SQUARE = "{material: fluid, shape: rectangle, center: [%s], size: [0.2, 0.2]}"
TURN = {"prescribed_velocity": "{field: rotation, center: [0.5, 0.5], angular_velocity: 1.0}", "run/end_time": 6.283185307179586}
SHIFT = {"prescribed_velocity": "{field: translation, velocity: [1.0, 0.6]}", "run/end_time": 0.5}
CENTRES = [(0.5, 0.5), (0.525, 0.464), (0.4871, 0.5137), (0.5039, 0.5208), (0.4756, 0.4683)]
LINE = "{disc: {material: fluid, shape: half-plane, point: [0.47, 0.53], normal: [%s, %s]}}"
NORMALS = [(1.0, 0.3), (-0.2, 1.0), (-1.0, -1.0), (0.7, -1.0)]
AT_REST = {"prescribed_velocity": STILL["prescribed_velocity"], "run/end_time": 1.0}
TWO = {"prescribed_velocity/period": 2.0, "run/end_time": 2.0}

# title: deck, settings (a list of them: the mean of their errors), cells along a side
CASES = {
    "circle at rest": ("vortex/deck.yaml", STILL, [32, 64, 128, 256]),
    "circle at rest, mean of five centres": ("vortex/deck.yaml", [{**STILL, "bodies/disc/center": f"[{x}, {y}]"} for x, y in CENTRES], [32, 64, 128, 256]),
    "straight line, random quadrilaterals, mean of four directions": ("vortex/deck.yaml", [{**AT_REST, "mesh/jitter": 0.24, "mesh/jitter_seed": i, "bodies": LINE % n} for i, n in enumerate(NORMALS)], [32, 64, 128]),
    "circle at rest, random quadrilaterals": ("vortex/deck.yaml", {**STILL, "mesh/jitter": 0.2}, [32, 64, 128, 256]),
    "vortex, T = 2": ("vortex/deck.yaml", TWO, [32, 64, 128, 256]),
    "vortex, T = 2, random quadrilaterals": ("vortex/deck.yaml", {**TWO, "mesh/jitter": 0.2}, [32, 64, 128]),
    "vortex, T = 8": ("vortex/deck.yaml", {}, [32, 64, 128, 256]),
    "vortex, T = 2, three materials": ("vortex/three_materials.yaml", {}, [32, 64, 128]),
    "vortex, T = 8, three materials": ("vortex/three_materials.yaml", {"prescribed_velocity/period": 8.0, "run/end_time": 8.0}, [32, 64, 128]),
    "deformation, T = 2": ("deformation/deck.yaml", {}, [32, 64, 128, 256]),
    "slotted disc, one turn": ("zalesak/deck.yaml", {}, [50, 100, 200]),
    "slotted disc, translation": ("zalesak/deck.yaml", {"prescribed_velocity": "{field: translation, velocity: [1.0, -1.5]}", "run/end_time": 1.0}, [50, 100, 200]),
    "square, one turn": ("vortex/deck.yaml", {**TURN, "bodies/disc": SQUARE % "0.5, 0.75"}, [32, 64, 128]),
    "disc, one turn": ("vortex/deck.yaml", TURN, [32, 64, 128]),
    "square, translation": ("vortex/deck.yaml", {**SHIFT, "bodies/disc": SQUARE % "0.2, 0.2"}, [32, 64, 128]),
    "disc, translation": ("vortex/deck.yaml", {**SHIFT, "bodies/disc/center": "[0.2, 0.2]"}, [32, 64, 128]),
}


def measure(deck, settings, n, method):
    """One run, or the mean of several."""
    if isinstance(settings, dict):
        return measure_one(deck, settings, n, method)
    runs = [measure_one(deck, one, n, method) for one in settings]
    failed = [r for r in runs if r["status"] != "completed"]
    if failed:
        return failed[0]
    mean = {key: sum(r[key] for r in runs) / len(runs) for key in runs[0] if key not in ("status", "volume_error")}
    return {"status": "completed", **mean, "volume_error": max(r["volume_error"] for r in runs)}


def measure_one(deck, settings, n, method):
    every = {"mesh/x/cells": n, "mesh/y/cells": n, "output/fields/every_time": 0.0, "output/fields/at_end": False, "output/history/every_time": 0.0}
    every.update({"numerics/reconstruction/" + key: value for key, value in method.items()})
    r = harmos(deck, {**every, **settings}, expect=None)
    s = r.summary
    clean(r)
    if s.get("status") != "completed":
        return {"status": s.get("status", "none"), "warnings": s.get("warnings", [r.text[-300:]])}
    errors = s["shape_errors"]
    names = [key[:-5] for key in errors if key.endswith(".area")]
    total = {key: sum(errors[name + "." + key] for name in names) for key in ["area", "l1", "symmetric_difference"]}
    return {"status": "completed", "cycles": s["cycles"], "cpu_seconds": s["cpu_seconds"], "restored_volume": errors["restored_volume"],
            "volume_error": max(abs(errors[name + ".volume_error"]) / errors[name + ".area"] for name in names), **total}


def table(title, results):
    """Symmetric difference (and L1) in units of area, beside the CPU seconds."""
    sizes = CASES[title][2]
    lines = [f"### {title}", "", "| cells | " + " | ".join(METHODS) + " |", "| --- |" + " --- |" * len(METHODS)]
    for n in sizes:
        row = []
        for method in METHODS:
            m = results[title].get(method, {}).get(str(n))
            if m is None:
                row.append("not run")
            elif m["status"] != "completed":
                row.append(m["status"])
            else:
                row.append(f"{m['symmetric_difference']:.2e}, {m['l1']:.2e}; {m['cpu_seconds']:.1f} s")
        lines.append(f"| {n} | " + " | ".join(row) + " |")
    return "\n".join(lines) + "\n"


def draw(results, x_of, x_label, path):
    titles = [t for t in ["circle at rest", "vortex, T = 2", "vortex, T = 8", "deformation, T = 2", "slotted disc, one turn", "vortex, T = 2, three materials"] if t in results]
    figure, axes = plt.subplots(2, 3, figsize=(12, 7.2), constrained_layout=True)
    for axis, title in zip(axes.flat, titles):
        for method, marker in zip(METHODS, "sov^"):
            points = [(x_of(int(n), m), m["symmetric_difference"] / m["area"]) for n, m in results[title].get(method, {}).items() if m["status"] == "completed"]
            if points:
                axis.loglog(*zip(*sorted(points)), marker + "-", label=method)
        axis.set_title(title)
        axis.set_xlabel(x_label)
        axis.set_ylabel("symmetric difference / area")
        axis.grid(True, which="both", alpha=0.25)
        if x_label.startswith("cells"):
            axis.set_xticks(CASES[title][2], labels=[str(n) for n in CASES[title][2]])
            axis.minorticks_off()
    axes.flat[0].legend(fontsize=8)
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--finest", type=int, default=128, help="leave out finer meshes (default: 128; all: 256)")
    parser.add_argument("--output", default=str(ROOT / "results/reconstruction_study"))
    parser.add_argument("--only", default="", help="run only the cases whose title contains this")
    parser.add_argument("--resume", action="store_true", help="keep what tables.json holds")
    options = parser.parse_args()
    folder = pathlib.Path(options.output)
    os.makedirs(folder, exist_ok=True)
    stored = folder / "tables.json"
    results = json.loads(stored.read_text()) if options.resume and stored.exists() else {}
    for title, (deck, settings, sizes) in CASES.items():
        for n in sizes:
            for method, keys in METHODS.items():
                known = results.get(title, {}).get(method, {})
                if n <= options.finest and options.only in title and str(n) not in known:
                    m = measure(deck, settings, n, keys)
                    results.setdefault(title, {}).setdefault(method, {})[str(n)] = m
                    print(title, n, method, m, flush=True)
                    stored.write_text(json.dumps(results, indent=1))
    (folder / "tables.md").write_text("\n".join(table(title, results) for title in CASES if title in results))
    draw(results, lambda n, m: n, "cells along a side", folder / "error_resolution.png")
    draw(results, lambda n, m: m["cpu_seconds"], "CPU time [s]", folder / "error_time.png")
    worst = max((m["volume_error"] for case in results.values() for method in case.values() for m in method.values() if m["status"] == "completed"), default=0.0)
    print(f"largest relative volume error: {worst:.1e}")
    if worst > 1e-12:
        raise SystemExit("a volume is not exact")


main()
