# SPDX-License-Identifier: BSD-3-Clause
"""Restitution: what strikes parts with its part of the closing speed; with one, the impact takes no energy."""
import pathlib

from harness import check, clean, harmos, run

HERE = pathlib.Path(__file__).resolve().parent
BALL = HERE / "rigid_ball.yaml"
V = 200.0


def ball(restitution, ranks=1, interaction="sliding"):
    """A rigid disc strikes a fixed rigid plate head on."""
    return harmos(BALL, {"bodies/plate": "{material: hard, shape: rectangle, center: [1.213, 0.5], size: [0.61, 0.9], motion: fixed}",
                         "bodies/ball/angular_velocity": 0.0, "run/end_time": 1.0e-3, "interactions": f"{{default: {interaction}, restitution: {restitution}}}"}, ranks=ranks)


def test_a_rigid_disc_leaves_a_rigid_plate_with_its_part_of_the_speed():
    for e in (0.5, 1.0):
        r = ball(e)
        mass, energy = r.last("ball.mass"), r.first("kinetic_energy")
        check(f"e = {e}: speed it leaves with, over V", abs(r.last("ball.momentum_x") / (mass * V) + e), 1e-9)
        check("speed across, over V: tilt of the fitted normal", abs(r.last("ball.momentum_y")) / (mass * V), 1e-4)
        check("energy taken, over m V^2 / 2 (1 - e^2)", abs(r.last("contact_loss") / energy - (1.0 - e * e)), 1e-9)
        check("energy error", r.summary["energy_error"], 1e-12)
        check("momentum error", r.summary["momentum_error"], 1e-12)
        clean(r)


def test_any_number_of_ranks_gives_the_same_rebound():
    one = ball(0.7)
    for ranks in (2, 4):
        r = ball(0.7, ranks)
        assert r["ball.momentum_x"] == one["ball.momentum_x"]
        check("contact loss against one rank", abs(r.last("contact_loss") / one.last("contact_loss") - 1.0), 1e-12)
        clean(r)
    clean(one)


def test_two_bars_rebound_without_a_loss_at_the_contact():
    # Their surfaces bounce many times while the bars press on each other; nothing is lost there, and linear viscosity alone would take it elsewhere.
    # A surface that opens and starts to close again within a step met the other at the end of it: 1e-4 to 1.6e-3 were lost but mid-cell.
    for place, courant in (0.5, 0.9), (0.0, 0.5), (0.12, 0.9):  # of the interface in its cell
        found = {}
        for e in (0.0, 1.0):
            at = 0.0125 * place
            r = harmos("two_bars/deck.yaml", {"interactions": f"{{default: sliding, restitution: {e}}}", "numerics/linear_viscosity": 0.0, "numerics/quadratic_viscosity": 0.0,
                                              "numerics/courant": courant, "bodies/left/center": f"[{at - 0.5!r}, 0.0]", "bodies/right/center": f"[{at + 0.5!r}, 0.0]",
                                              "output/fields": "{at_end: false}"})
            found[e] = (r.last("contact_loss") / r.first("kinetic_energy"), r.last("right.momentum_x") / (r.last("right.mass") * 5.0))
            print(f"  interface at {place} of a cell, e = {e}: contact takes {found[e][0]:.2e} of the energy, exit velocity {found[e][1]:.4f}")
            check("energy error", r.summary["energy_error"], 1e-10)
            check("momentum, over that of one bar", max(abs(p) for p in r["momentum_x"]) / (5.0 * r.last("right.mass")), 1e-12)
            clean(r)
        check("e = 1: taken by contact", abs(found[1.0][0]), 1e-12)
        check("e = 1: exit velocity, short of V/2", 1.0 - found[1.0][1], 0.02)
        assert found[0.0][0] > 5e-3


run(globals())
