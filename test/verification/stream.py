# SPDX-License-Identifier: BSD-3-Clause
"""Inflow and outflow: a uniform stream through an open box stays uniform, and what flows in and out is booked."""
import pathlib

from harness import check, clean, harmos, run

HERE = pathlib.Path(__file__).resolve().parent
STREAM = HERE / "decks/stream.yaml"
RHO, V, WIDTH = 1000.0, 300.0, 0.5


def ledger(r):
    check("energy error", r.summary["energy_error"], 1e-10)
    check("momentum error", r.summary["momentum_error"], 1e-12)
    check("mass error", r.summary["mass_error"], 1e-12)


def uniform(settings, what):
    r = harmos(STREAM, settings)
    print(f"  {what}")
    mass = r.first("mass")
    check("mass in the box", max(abs(m / mass - 1.0) for m in r["mass"]), 1e-12)
    for column, speed in (("momentum_x", V), ("momentum_y", V)):
        check(column, max(abs(p - r.first(column)) for p in r[column]) / (mass * speed), 1e-12)
    check("kinetic energy", max(abs(k / r.first("kinetic_energy") - 1.0) for k in r["kinetic_energy"]), 1e-12)
    check("internal energy", max(abs(e) for e in r["internal_energy"]) / r.first("kinetic_energy"), 1e-12)
    # Booked outflow is net of inflow.
    check("outflow less inflow", max(abs(m) for m in r["outflow_mass"]) / mass, 1e-12)
    ledger(r)
    clean(r)


def test_a_uniform_stream_stays_uniform():
    uniform({}, "along the box")
    uniform({"kinematics": "single"}, "single")


def test_a_uniform_stream_along_the_axis_stays_uniform():
    along = "[0.0, 300.0]"
    sides = {"left": "slip wall", "right": "slip wall", "bottom": "inflow", "top": "outflow"}
    settings = {"geometry": "axisymmetric", "bodies/water/velocity": along}
    for side, kind in sides.items():
        settings[f"boundaries/{side}"] = "{type: inflow, body: water, velocity: [0.0, 300.0]}" if kind == "inflow" else \
            f"{{type: {kind}}}"
    r = harmos(STREAM, settings)
    mass = r.first("mass")
    check("mass in the pipe", max(abs(m / mass - 1.0) for m in r["mass"]), 1e-12)
    check("axial momentum", max(abs(p - r.first("momentum_y")) for p in r["momentum_y"]) / (mass * V), 1e-12)
    check("internal energy", max(abs(e) for e in r["internal_energy"]) / r.first("kinetic_energy"), 1e-12)
    check("outflow less inflow", max(abs(m) for m in r["outflow_mass"]) / mass, 1e-12)
    ledger(r)
    clean(r)


def test_a_front_fills_the_box_and_leaves_it():
    """A body of a third of the box, carried on by what flows in behind it: rho V t flows in until the front leaves."""
    r = harmos(STREAM, {"bodies/water/center": "[0.155, 0.25]", "bodies/water/size": "[0.31, 0.5]",
                       "run/end_time": "2.5e-3"})
    mass = RHO * 0.31 * WIDTH
    for i, t in enumerate(r["time"]):
        front = 0.31 + V * t
        inside = min(front, 1.0) * RHO * WIDTH
        assert abs(r["mass"][i] - inside) <= 1e-11 * RHO * WIDTH, (t, r["mass"][i], inside)
        assert abs(r["outflow_mass"][i] - (mass - inside)) <= 1e-11 * RHO * WIDTH, t
        assert abs(r["water.x_max"][i] - min(front, 1.0)) <= 1e-9, (t, r["water.x_max"][i], front)
    check("front beyond the box", 1.0 - (0.31 + V * r.last("time")), 0.0)
    check("momentum", abs(r.last("momentum_x") / (RHO * WIDTH * V) - 1.0), 1e-11)
    ledger(r)
    clean(r)


if __name__ == "__main__":
    run(globals())
