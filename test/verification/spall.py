# SPDX-License-Identifier: BSD-3-Clause
"""Spall of a struck plate against exact acoustics, conservation through fragmentation, ranks and restart; Johnson-Cook
damage of drawn steel against its integral.

One-dimensional, without strength. The pulse in the target falls linearly from P = rho c V / 2 within the flyer's length
d; where it has been reflected, the tension at depth z below the rear is 2 P z / d. It reaches sigma at z = sigma d / (2 P):
the thickness of the scab, whose rear falls back by 2 sigma / (rho c) before the news of the spall plane arrives, and
which keeps the momentum of the pulse within it: mean speed V - sigma / (rho c).
"""
from math import exp, log

import h5py
import numpy

from harness import ROOT, check, clean, harmos, read_columns, run
from hugoniot import law_of, temperature

STRIP = "spall/strip.yaml"
RHO, C, V, D, SIGMA = 2703.0, 5240.0, 100.0, 4.0e-3, 0.45e9
P = 0.5 * RHO * C * V
SCAB = SIGMA * D / (2.0 * P)
QUIET = {"output/fields/every_time": 0.0}


def tracer(r, name):
    """Times and velocities of a tracer."""
    rows = read_columns(r.directory / "tracers.csv")
    mine = [i for i, n in enumerate(rows["name"]) if n == name]
    return tuple(numpy.array([rows[column][i] for i in mine]) for column in ("time", "velocity_x"))


def void_in_target(r):
    """Cell centres and void fractions within the target, two cells away from its surfaces."""
    with h5py.File(sorted(r.directory.glob("fields_*.h5"))[-1]) as file:
        x = file["/nodes/position"][:][file["/cells/connectivity"][:]].mean(axis=1)[:, 0]
        void = 1.0 - file["/cells/volume_fraction"][:]
    h = x[1] - x[0]
    inside = (x > r.last("target.x_min") + 2.0 * h) & (x < r.last("target.x_max") - 2.0 * h)
    return x[inside], void[inside], h


def conserves(r):
    check("mass", r.summary["mass_error"], 1e-12)
    check("momentum", r.summary["momentum_error"], 1e-12)
    check("energy ledger", r.summary["energy_error"], 1e-10)


def test_scab_and_pull_back_are_those_of_acoustics():
    errors = []
    for cells in (300, 600):
        r = harmos(STRIP, {**QUIET, "mesh/x/cells": cells, "mesh/y/to": 1.2e-2 / cells})
        time, velocity = tracer(r, "rear")
        least = V - 2.0 * SIGMA / (RHO * C)
        pulled = velocity[(time > 1.3e-6) & (time < 1.75e-6)].min()
        errors.append(abs(pulled - least) / (V - least))
        period = 2.0 * SCAB / C
        whole = (time > time[-1] - period)
        mean = float(numpy.average(velocity[whole], weights=numpy.gradient(time)[whole]))
        x, void, h = void_in_target(r)
        # The pulse breaks a second plane at twice the depth, whose void may be in fewer cells: the first has the most in eleven.
        main = abs(x - x[numpy.convolve(void, numpy.ones(11), "same").argmax()]) < 5.5 * h
        plane = float((x * void)[main].sum() / void[main].sum())
        scab = r.last("target.x_max") - plane - 0.5 * h * void[main].sum()
        print(f"  {cells} cells: scab {1e3 * scab:.3f} mm (exact {1e3 * SCAB:.3f}), rear falls to {pulled:.2f} m/s (exact "
              f"{least:.2f}), then {mean:.2f} in the mean (exact {V - SIGMA / (RHO * C):.2f})")
        conserves(r)
        assert r.last("target.failed_mass") > 0.0 and r.last("flyer.failed_mass") == 0.0
        clean(r)
    check("thickness of the scab, cells off", abs(scab - SCAB) / h, 3.0)
    check("pull-back, 300 cells", errors[0], 0.05)
    check("pull-back, 600 cells", errors[1], 0.025)
    # What the scab loses while its gap opens across whole cells falls slowly: 7.2, 6.2, 4.7 per cent at 300, 600, 1200.
    check("mean speed of the scab", abs(mean / (V - SIGMA / (RHO * C)) - 1.0), 0.065)


def test_tension_below_the_limit_leaves_the_plate_whole():
    r = harmos(STRIP, {**QUIET, "materials/metal/spall_pressure": 1.2 * P})
    assert r.last("target.failed_mass") == 0.0
    check("void within the target", float(void_in_target(r)[1].max()), 1e-9)
    conserves(r)
    clean(r)


def test_results_do_not_depend_on_the_number_of_ranks_and_a_restart_goes_on():
    small = {"mesh/x/cells": 60, "mesh/y/cells": 60, "run/end_time": 3.0e-6, "output/checkpoint/every_time": 1.0e-6}
    one = harmos("spall/deck.yaml", {**QUIET, **small})
    two = harmos("spall/deck.yaml", {**QUIET, **small}, ranks=2)
    first = sorted(one.directory.glob("checkpoint_*.h5"))[0]
    again = harmos("spall/deck.yaml", {**QUIET, **small}, extra=("--restart", str(first)))
    for other in (two, again):
        for column in ("plate.failed_mass", "plate.plastic_strain_max", "plate.y_max"):
            check(column, abs(other.last(column) - one.last(column)) / abs(one.last(column)), 1e-13)
    assert one.last("plate.failed_mass") > 0.0
    conserves(one)
    clean(one, two, again)


def test_damage_of_drawn_steel_is_the_integral_of_johnson_and_cook():
    law = law_of("steel-4340-johnson-cook.yaml")
    r = harmos(str(ROOT / "test/verification/decks/tension.yaml"))
    rows = read_columns(r.directory / "tracers.csv")
    damage = failed_at = 0.0
    for i in range(1, len(rows["time"])):
        step = rows["plastic_strain"][i] - rows["plastic_strain"][i - 1]
        if step <= 0.0:
            continue
        if rows["damage"][i] == 1.0:  # what failed has no stress: the last step at the failure strain before
            damage += step / strain
            failed_at = rows["time"][i]
            break
        rate = step / (rows["time"][i] - rows["time"][i - 1])
        t = temperature(law, rows["density"][i], rows["internal_energy"][i])
        t0 = law["reference_temperature"]
        hot = min(max((t - t0) / (law["melting_temperature"] - t0), 0.0), 1.0)
        triaxiality = min(-rows["pressure"][i] / rows["von_mises"][i], 1.5)
        strain = (law["D1"] + law["D2"] * exp(law["D3"] * triaxiality)) * \
            (1.0 + law["D4"] * log(max(rate / law["reference_rate"], 1.0))) * (1.0 + law["D5"] * hot)
        damage += step / strain
        last = abs(rows["damage"][i] / damage - 1.0)
    print(f"  D = {damage:.4f} at {1e6 * failed_at:.2f} us, strain {rows['plastic_strain'][i]:.3f}, triaxiality {triaxiality:.2f}, "
          f"rate {rate:.1e} /s")
    check("damage against the integral before failure", last, 1e-4)
    assert damage - step / strain < 1.0 <= damage, "the step in which the integral passes one is that of the failure"
    check("stress afterwards", max(rows["von_mises"][i + 1:]), 0.0)
    check("tension afterwards", -min(rows["pressure"][i + 1:]) / law["yield_stress"], 1e-3)
    conserves(r)
    clean(r)


if __name__ == "__main__":
    run(globals())
