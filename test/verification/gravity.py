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
    # v^{n+1/2} is the velocity at the middle of the step, exactly: forces act from the middle of the last one to there.
    speed, fall = G * r.time_of_velocities(), 0.5 * G * r.last("time") ** 2
    check("speed", abs(r.last("momentum_y") / mass + speed) / speed, 1e-12)
    check("speed across", abs(r.last("momentum_x") / mass - 20.0) / 20.0, 1e-12)
    middle = lambda row: 0.5 * (r["column.y_min"][row] + r["column.y_max"][row])
    check("fall of the middle, in cells", abs(middle(0) - middle(-1) - fall) / 0.05, 1e-4)
    check("work of gravity over m v^2 / 2", abs(r.last("external_work") / (0.5 * mass * speed**2) - 1.0), 1e-12)
    check("internal energy over the work of gravity", abs(r.last("internal_energy") - r.first("internal_energy")) / r.last("external_work"), 1e-12)
    ledger(r)
    clean(r)


def test_a_disc_that_rebounds_comes_back_to_its_height():
    # Steps of 6 to 78 ms, which change with its speed. Forces that act for the step ahead take 3% of the height a bounce.
    height = 0.6
    r = harmos(HERE / "decks/bouncing_disc.yaml")
    y, energy = r["disc.y_min"], 2.0 * 9.81 * height
    # Potential energy at the time of the velocity, half a step back.
    kept = [2.0 * (e / r.first("disc.mass") + 9.81 * (y1 - 0.1 - 0.5 * dt * v / m)) / energy
            for e, y1, dt, v, m in zip(r["disc.kinetic_energy"][1:], y[1:], r["dt"][1:], r["disc.momentum_y"][1:], r["disc.mass"][1:])]
    tops = [y[i] - 0.1 for i in range(1, len(y) - 1) if y[i] >= y[i - 1] and y[i] > y[i + 1]]
    print("  heights:", ", ".join(f"{h:.4f}" for h in tops), f"; steps {min(r['dt'][1:]):.4f} to {max(r['dt']):.4f} s")
    assert len(tops) == 3
    check("height lost in three rebounds, over the height", max(abs(h / height - 1.0) for h in tops), 3e-3)
    check("energy while it flies, over m g h", max(abs(k - 1.0) for k in kept), 0.02)
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
