# SPDX-License-Identifier: BSD-3-Clause
"""Whipple shields about the axis: below the ballistic limit against the body-fitted run, above it against what is
conserved.
"""
import subprocess
import sys

import numpy

from harness import EXAMPLE, HARMOS, check, clean, harmos, run, scratch_folder

sys.path.insert(0, str(EXAMPLE / "whipple_high"))
sys.path.insert(0, str(EXAMPLE / "whipple_batch"))
import batch  # noqa: E402
import measure  # noqa: E402

QUIET = {"output/fields/every_time": 0.0, "output/fields/at_end": False}


def position(r, column, time):
    return float(numpy.interp(time, r["time"], r[column]))


def test_fronts_of_a_slow_impact_are_those_of_the_body_fitted_run():
    folder = scratch_folder()
    coarse = {"mesh/x/cells": 48, "mesh/y/cells": 80, **QUIET}  # 4 cells through the bumper
    sphere = subprocess.run([sys.executable, EXAMPLE / "whipple_low/make_sphere.py", "3.175e-3", "-3.175e-3", "6"],
                            check=True, stdout=subprocess.PIPE, text=True).stdout
    (folder / "sphere.msh").write_text(sphere)
    eulerian = harmos("whipple_low/deck.yaml", coarse)
    fitted = harmos("whipple_low/lagrangian.yaml", {**coarse, "mesh/file": folder / "sphere.msh"}, directory=folder / "run")
    check("mass of the sphere, painted against meshed", abs(eulerian.first("sphere.mass") / fitted.first("sphere.mass") - 1.0), 5e-3)
    for column in ("sphere.y_max", "bumper.y_max", "rear.y_max"):
        found = [(position(eulerian, column, t), position(fitted, column, t)) for t in (6e-6, 12e-6, 18e-6, 24e-6)]
        print(f"  {column} [mm]: " + ", ".join(f"{1e3 * a:.3f} and {1e3 * b:.3f}" for a, b in found))
        check(column, max(abs(a / b - 1.0) for a, b in found), 0.02)
    assert fitted.last("rear.y_max") > 7.5e-3, "the wall is bent"
    for r in (eulerian, fitted):
        check("mass", r.summary["mass_error"], 1e-12)
        check("energy ledger", r.summary["energy_error"], 1e-10)
    # the wall's rim is held: its impulse is in the history
    check("axial momentum", eulerian.summary["momentum_error"], 1e-12)
    clean(eulerian, fitted)


# While a tip of the sphere could be put above the bumper that it came in below of, eight of twenty such runs had a
# splinter of it ahead by 1 to 5% of its way, these three among them (decision 0025).
def test_no_splinter_of_the_sphere_gets_ahead():
    found = []
    for steps in (9, 10, 15):
        r = harmos("whipple_low/deck.yaml", {"mesh/x/cells": 48, "mesh/y/cells": 80, "run/end_time": 1.65e-5,
                                             "numerics/courant": 0.5 - 1e-6 * steps, **QUIET})
        found.append(position(r, "sphere.y_max", 1.6e-5))
        clean(r)
    print("  front at 16 us [mm]: " + ", ".join(f"{1e3 * y:.3f}" for y in found))
    check("front of the sphere, from 4.30 mm", max(abs(y / 4.30e-3 - 1.0) for y in found), 0.005)


def test_a_fast_impact_perforates_bumper_and_wall_and_keeps_mass_and_momentum():
    coarse = {"mesh/x/cells": 50, "mesh/y/cells": 120, "run/end_time": 2.1e-5, "output/fields/every_time": 0.0}
    r = harmos("whipple_high/deck.yaml", coarse)
    assert r.summary["status"] == "completed" and r.last("time") > 2.0e-5
    check("mass", r.summary["mass_error"], 1e-12)
    check("axial momentum", r.summary["momentum_error"], 1e-12)
    check("energy ledger", r.summary["energy_error"], 1e-10)
    check("unconverged cycles", r.summary["unconverged_cycles"], 5)
    last = measure.frames(r.directory)[-1]
    hole = min(measure.holeDiameters(last, "bumper", 0.0, 2.0e-3, 0.4 * 9.53e-3))
    expected = measure.maidenAndMcMillan(9.53e-3, 2.0e-3, 6700.0)
    print(f"  hole {1e3 * hole:.2f} mm, Maiden and McMillan {1e3 * expected:.2f} mm")
    check("hole in the bumper", abs(hole / expected - 1.0), 0.1)
    # a hole opens just now: what last thread holds depends on every bit before
    check("wall left where thinnest, of 4 mm", measure.leastThickness(last, "rear", 9.53e-3) / 4.0e-3, 0.5)
    axial, _ = measure.frontSpeeds(measure.history(r.directory), 48.0e-3)
    print(f"  debris front {1e-3 * axial:.2f} km/s")
    assert 0.8 < axial / 6700.0 < 1.0, "no slower than sphere and plug after an inelastic impact, no faster than the sphere"
    clean(r)


def test_ballistic_limit_is_christiansen_s():
    # tw 0.127 cm of 57 ksi, tb 0.1 cm, S 10 cm, 2.8 and 2.7 g/cm3, worked out apart from the script, at 3 and 7 km/s
    shield = {"tw": 1.27e-3, "tb": 1.0e-3, "gap": 0.1, "yield_w": 57.0 * batch.KSI, "rho_p": 2800.0, "rho_b": 2700.0}
    for speed, centimetres in ((3000.0, 0.13467), (7000.0, 0.34579), (5000.0, 0.5 * (0.13467 + 0.34579))):
        check(f"{speed} m/s", abs(100.0 * batch.criticalDiameter({**shield, "speed": speed}) / centimetres - 1.0), 1e-3)


def test_a_batch_runs_a_shot_once_and_finds_a_foil_perforated():
    folder = scratch_folder()
    command = [sys.executable, EXAMPLE / "whipple_batch/batch.py", "--harmos", HARMOS, "--results", folder, "--cells", "4",
               "--shots", "CR-54201_91"]
    first, again = (subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout for _ in range(2))
    print("  " + first.splitlines()[1])
    assert first == again and len(list(folder.glob("*/run/history.csv"))) == 1
    assert "harmos: 1 of 1 as in the experiment" in first
    unknown = subprocess.run(command[:-1] + ["NOBODY_1"], check=False, stderr=subprocess.PIPE, text=True)
    assert unknown.returncode != 0 and "NOBODY_1" in unknown.stderr


if __name__ == "__main__":
    run(globals())
