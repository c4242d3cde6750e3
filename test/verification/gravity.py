# SPDX-License-Identifier: BSD-3-Clause
"""Gravity: free fall, and a column that rests on a contact wall or a slip wall (exact elastic column)."""
import pathlib
from math import sqrt

from harness import check, clean, harmos, run

HERE = pathlib.Path(__file__).resolve().parent
COLUMN = HERE / "decks/column.yaml"
G, HEIGHT = 1.0e4, 0.81
C = sqrt(4600.0**2 + 4.0 * 80.0e9 / (3.0 * 7800.0))


def ledger(r):
    check("energy error", r.summary["energy_error"], 1e-10)
    check("momentum error", r.summary["momentum_error"], 1e-12)
    check("mass error", r.summary["mass_error"], 1e-12)


def test_a_body_falls_freely():
    r = harmos(COLUMN, {"mesh/x": "{from: 0.0, to: 1.0, cells: 20}", "mesh/y": "{from: -1.0, to: 1.0, cells: 40}",
                        "boundaries/bottom": "{type: outflow}", "boundaries/left": "{type: outflow}",
                        "boundaries/right": "{type: outflow}", "bodies/column/center": "[0.51, 0.4]",
                        "bodies/column/size": "[0.3, 0.2]", "bodies/column/angle": "25.0",
                        "bodies/column/velocity": "[20.0, 0.0]", "run/end_time": "8.0e-3"})
    mass = r.last("mass")
    # v^{n+1/2} = - g times the sum of the steps; y moves with it.
    fall = speed = 0.0
    for dt in r["dt"][1:]:
        speed += G * dt
        fall += speed * dt
    check("speed", abs(r.last("momentum_y") / mass + speed) / speed, 1e-12)
    check("speed across", abs(r.last("momentum_x") / mass - 20.0) / 20.0, 1e-12)
    middle = lambda row: 0.5 * (r["column.y_min"][row] + r["column.y_max"][row])
    check("fall of the middle, in cells (its corners round off)", abs(middle(0) - middle(-1) - fall) / 0.05, 0.1)
    check("work of gravity over m v^2 / 2", abs(r.last("external_work") / (0.5 * mass * speed**2) - 1.0), 1e-12)
    check("internal energy over the work of gravity", abs(r.last("internal_energy") - r.first("internal_energy")) / r.last("external_work"), 1e-12)
    ledger(r)
    clean(r)


def rest(floor):
    r = harmos(COLUMN, {"boundaries/bottom": f"{{type: {floor}}}"})
    mass = r.last("mass")
    period = 4.0 * HEIGHT / C
    # Loaded at once the column swings about its rest: momentum between 0 and - m g h / (2 c), then as far beyond 0.
    largest = mass * G * HEIGHT / (2.0 * C)
    check("largest momentum down", abs(min(r["momentum_y"]) / largest + 1.0), 0.02)
    # Over whole periods the floor has carried the weight.
    last = max(i for i, t in enumerate(r["time"]) if t <= 2.0 * period)
    weight = mass * G * r["time"][last]
    floor_impulse = r["external_impulse_y"][last] + weight
    check("impulse of the floor over the weight's", abs(floor_impulse / weight - 1.0), 0.01)
    check("height of the base over the static settlement", max(r["column.y_min"]) / (G * HEIGHT**2 / C**2), 0.01)
    ledger(r)
    clean(r)


def test_a_column_rests_on_a_contact_wall():
    rest("contact wall")


def test_a_column_rests_on_a_slip_wall():
    rest("slip wall")


if __name__ == "__main__":
    run(globals())
