# SPDX-License-Identifier: BSD-3-Clause
"""Three materials in uniform translation: exact answer is no change but of place."""
from math import hypot

from harness import check, clean, harmos, run

DECK = "translation_patch/deck.yaml"
NAMES = ["matrix", "disc", "wedge"]


def examine(r):
    speed = hypot(300.0, 200.0)
    for name in NAMES:
        mass = r.first(name + ".mass")
        check(f"{name} mass", abs(r.last(name + ".mass") - mass) / mass, 1e-12)
        check(f"{name} velocity x", abs(r.last(name + ".momentum_x") / mass - 300.0) / speed, 1e-9)
        check(f"{name} velocity y", abs(r.last(name + ".momentum_y") / mass - 200.0) / speed, 1e-9)
        # Stored energy is zero at the start: all that appears is noise. p ~ rho c^2 dV/V; e ~ (c^2/2) (dV/V)^2.
        check(f"{name} internal energy", abs(r.last(name + ".internal_energy")) / (mass * speed**2), 1e-12)
    check("momentum", r.summary["momentum_error"], 1e-12)
    check("energy ledger", r.summary["energy_error"], 1e-10)


def test_three_materials_translate():
    r = harmos(DECK, {"output/fields/every_time": 0.0})
    examine(r)
    clean(r)


def test_first_order_and_youngs_translate_too():
    r = harmos(DECK, {"output/fields/every_time": 0.0, "numerics/remap/order": 1, "numerics/reconstruction/method": "youngs", "run/end_time": 5e-4})
    examine(r)
    clean(r)


if __name__ == "__main__":
    run(globals())
