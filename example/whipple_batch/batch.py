#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Run shots on Whipple shields from a table, decide which walls are perforated, compare with experiment and with the
ballistic limit equation.

One shot is one deck, made from shot.yaml.in; a shot whose result is in the results folder is not run again. See
README.md for the table, the laws, the criterion and what was found.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import string
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "whipple_high")]
from completed_run import completedRun  # noqa: E402
import measure  # noqa: E402

KSI = 6.894757e6
# Typical yield stresses of the alloys [ksi] (Metallic Materials Properties Development and Standardization, handbook of
# the US Federal Aviation Administration; soft aluminium: ASM Metals Handbook, vol. 2). The wall's is in the table.
YIELD = {"AA1100-O": 5.0, "AA2017-T4": 40.0, "AA2024-T3": 50.0, "AA2024-T351": 50.0, "AA2024-T4": 47.0, "AA2219-T851": 51.0,
         "AA2219-T87": 57.0, "AA5154-O": 17.0, "AA6061-T6": 40.0, "AA7075-T6": 73.0, "AA99.9%": 3.0, "Alclad 7075-T6": 67.0}
CELLS_ACROSS = 8  # the sphere
LEFT = 0.05       # of the wall's thickness: thinner is a hole
BEYOND = 1e-3     # of the sphere's volume, of sphere and bumper behind the wall


def readShots(path):
    """Rows of the table as dictionaries in SI units, yield stresses in Pa."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    shots = []
    for row in rows[1:]:  # the first row holds the units
        shots.append({"id": f"{row['source'].strip()}_{row['shotID'].strip()}".replace("/", "-").replace(" ", ""), "source": row["source"].strip(),
                      "projectile": row["proj_mat"], "bumper": row["bumper_mat"], "speed": 1e3 * float(row["velocity"]),
                      "d": 1e-2 * float(row["proj_diam"]), "tb": 1e-2 * float(row["bumper_thick"]), "gap": 1e-2 * float(row["standoff"]),
                      "tw": 1e-2 * float(row["wall_thick"]), "rho_p": 1e3 * float(row["proj_density"]), "rho_b": 1e3 * float(row["bumper_density"]),
                      "rho_w": 1e3 * float(row["wall_density"]), "yield_w": KSI * float(row["wall_yield"]),
                      "perforated": int(row["perforated_class"]) == 1})
    return shots


def criticalDiameter(s):
    """Largest sphere that the shield stops [m]: Christiansen, Int. J. Impact Eng. 14 (1993) 145-156, normal impact.

    In cm, g/cm3, ksi, km/s. V <= 3: d = ((tw sqrt(Y / 40) + tb) / (0.6 sqrt(rho_p) V^(2/3)))^(18/19);
    V >= 7: d = 3.918 tw^(2/3) S^(1/3) (Y / 70)^(1/3) rho_p^(-1/3) rho_b^(-1/9) V^(-2/3); linear between.
    """
    tw, tb, gap = 100.0 * s["tw"], 100.0 * s["tb"], 100.0 * s["gap"]
    strength, speed, rho_p, rho_b = s["yield_w"] / KSI, 1e-3 * s["speed"], 1e-3 * s["rho_p"], 1e-3 * s["rho_b"]

    def slow(v):
        return ((tw * math.sqrt(strength / 40.0) + tb) / (0.6 * math.sqrt(rho_p) * v ** (2.0 / 3.0))) ** (18.0 / 19.0)

    def fast(v):
        return 3.918 * tw ** (2.0 / 3.0) * gap ** (1.0 / 3.0) * (strength / 70.0) ** (1.0 / 3.0) * rho_p ** (-1.0 / 3.0) * \
            rho_b ** (-1.0 / 9.0) * v ** (-2.0 / 3.0)

    if speed <= 3.0:
        return 0.01 * slow(speed)
    if speed >= 7.0:
        return 0.01 * fast(speed)
    part = (speed - 3.0) / 4.0
    return 0.01 * ((1.0 - part) * slow(3.0) + part * fast(7.0))


def deckOf(s, cells_across):
    """The deck of a shot: cells of one size: a part of the sphere, half the bumper, a third of the wall, but not below 0.8 of the first."""
    h = max(min(s["d"] / cells_across, s["tb"] / 2.0, s["tw"] / 3.0), 0.8 * s["d"] / cells_across)
    back = s["tb"] + s["gap"] + s["tw"]
    radius = max(0.45 * s["gap"], 3.0 * s["d"])
    bottom, top = -2.0 * s["d"], back + 3.0 * s["d"]
    cells_r, cells_z = math.ceil(radius / h), math.ceil((top - bottom) / h)
    # the slow rear of the cloud arrives at 0.6 of the speed; then time for the wall to give way
    end = (s["gap"] + 2.0 * s["d"]) / (0.6 * s["speed"]) + 6.0 * (min(s["tw"], 2.0 * s["d"]) + s["d"]) / min(s["speed"], 2000.0)
    values = {**s, "shot": s["id"], "d_mm": 1e3 * s["d"], "radius": h * cells_r, "cells_r": cells_r, "cells_z": cells_z,
              "bottom": bottom, "top": bottom + h * cells_z, "law": HERE.parent / "materials/aluminium-tillotson.yaml",
              "yield_p": KSI * YIELD[s["projectile"]], "yield_b": KSI * YIELD[s["bumper"]], "spall": 1.2e9,
              "centre": -0.5 * s["d"] - 1e-6 * s["d"], "r_p": 0.5 * s["d"], "bumper_middle": 0.5 * s["tb"],
              "across": 4.0 * h * cells_r, "bumper_thickness": s["tb"], "rear_middle": back - 0.5 * s["tw"],
              "rear_thickness": s["tw"], "end_time": end, "max_cycles": 20000}
    text = {key: f"{value:.9e}" if isinstance(value, float) else str(value) for key, value in values.items()}
    return string.Template((HERE / "shot.yaml.in").read_text(encoding="utf-8")).substitute(text)


def judge(directory, s):
    """What the last output shows: (perforated, thickness left over tw, volume beyond the wall over the sphere's)."""
    frame = measure.frames(str(directory))[-1]
    back = s["tb"] + s["gap"] + s["tw"]
    left = measure.leastThickness(frame, "rear", 2.0 * s["d"]) / s["tw"]
    sphere = s["d"] ** 3 / 12.0  # per radian
    beyond = sum(measure.volumeBeyond(frame, name, back + s["d"]) for name in ("sphere", "bumper")) / sphere
    return bool(left < LEFT or beyond > BEYOND), float(left), float(beyond)


def runShot(s, options):
    """The result of a shot, which is run unless it is there; RuntimeError where the program fails."""
    folder = pathlib.Path(options.results) / s["id"]
    done = folder / "result.json"
    if done.exists():
        return json.loads(done.read_text(encoding="utf-8"))
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "deck.yaml").write_text(deckOf(s, options.cells), encoding="utf-8")
    summary = completedRun(options.harmos, folder / "deck.yaml", folder / "run")
    perforated, left, beyond = judge(folder / "run", s)
    result = {"perforated": perforated, "left": left, "beyond": beyond, "cycles": summary["cycles"],
              "cpu_seconds": summary["cpu_seconds"], "end_time": summary["end_time"],
              "mass_error": summary["mass_error"], "momentum_error": summary["momentum_error"]}
    done.write_text(json.dumps(result, indent=1), encoding="utf-8")
    return result


def spread(shots, count):
    """The shots below 1.5 km/s and `count` others, evenly spread over those sorted by speed, whose size can be run."""
    slow = [s for s in shots if s["speed"] < 1500.0]
    others = sorted((s for s in shots if s["speed"] >= 1500.0 and s["gap"] / s["d"] <= 20.0 and s["d"] / s["tb"] <= 16.0 and
                     s["tw"] / s["d"] <= 2.0 and s["gap"] > s["d"]), key=lambda s: (s["speed"], s["id"]))
    step = len(others) / max(count, 1)
    return slow + [others[int((i + 0.5) * step)] for i in range(min(count, len(others)))]


def agreement(rows, name):
    """Lines of a comparison of verdicts with the experiment."""
    right = sum(row[name] == row["experiment"] for row in rows)
    missed = sum(row["experiment"] and not row[name] for row in rows)
    false = sum(row[name] and not row["experiment"] for row in rows)
    return f"{name}: {right} of {len(rows)} as in the experiment; {missed} perforations missed, {false} that were not"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--table", default=str(HERE / "data/whipple-normal-aluminium.csv"), help="table of shots")
    parser.add_argument("--results", default=os.environ.get("HARMOS_RESULTS", "results"), help="a folder for each shot in it")
    parser.add_argument("--harmos", default=os.environ.get("HARMOS", "harmos"), help="the program")
    parser.add_argument("--shots", nargs="+", help="ids (source_shotID); else those below 1.5 km/s and --count others")
    parser.add_argument("--count", type=int, default=0, help="further shots, spread over the speeds (0)")
    parser.add_argument("--cells", type=int, default=CELLS_ACROSS, help=f"across the sphere ({CELLS_ACROSS})")
    parser.add_argument("--part", type=int, nargs=2, metavar=("K", "N"), help="every N-th shot from the K-th: several at once")
    parser.add_argument("--list", action="store_true", help="name the shots and run none")
    options = parser.parse_args()
    shots = readShots(options.table)
    chosen = spread(shots, options.count)
    if options.shots:
        unknown = set(options.shots) - {s["id"] for s in shots}
        if unknown:
            sys.exit(f"batch.py: --shots {' '.join(sorted(unknown))}: not in {options.table}")
        chosen = [s for s in shots if s["id"] in options.shots]
    if options.part:
        chosen = chosen[options.part[0]::options.part[1]]
    if options.list:
        print("\n".join(s["id"] for s in chosen))
        return
    rows = []
    print("shot, km/s, experiment, harmos (wall left, debris beyond), equation (d / dc), cycles, CPU s", flush=True)
    verdict = {True: "P", False: "NP"}
    for s in chosen:
        limit = s["d"] / criticalDiameter(s)
        try:
            result = runShot(s, options)
        except RuntimeError as error:
            print(f"{s['id']}: {error}", flush=True)
            continue
        rows.append({"experiment": s["perforated"], "harmos": result["perforated"], "equation": limit > 1.0})
        print(f"{s['id']}, {1e-3 * s['speed']:.2f}, {verdict[s['perforated']]}, {verdict[result['perforated']]} ({result['left']:.2f}, "
              f"{result['beyond']:.4f}), {verdict[limit > 1.0]} ({limit:.2f}), {result['cycles']}, {result['cpu_seconds']:.0f}", flush=True)
    print(f"{len(rows)} of {len(chosen)} shots have a result")
    if rows:
        print(agreement(rows, "harmos") + "\n" + agreement(rows, "equation"))


if __name__ == "__main__":
    main()
