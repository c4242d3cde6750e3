# SPDX-License-Identifier: BSD-3-Clause
"""Planar Taylor rod: convergence of the length, energy, wall against second-material anvil, xfem against lagrangian.

The wall stops the rod's lowest row of nodes at once: an inelastic impact of half a cell, H / (2 L) of the energy, which a
slip wall books as external work and a contact as its loss. The drift that the figures bound is what is left of the
energy after external work and contact loss: what the remap loses.
"""
from harness import check, clean, harmos, run

DECK = "taylor_rod/deck.yaml"
QUIET = {"output/fields/every_time": 0.0}
RADIUS, LENGTH = 0.0032, 0.0324
SLIP = {"boundaries/bottom/type": "slip wall"}
ANVIL_DEPTH = 0.0064
RIGID = "{eos: rigid, density: 15600.0}"
CARBIDE = "{eos: stiffened, density: 15600.0, sound_speed: 5060.0, strength: elastic, shear_modulus: 280.0e9}"


def length(r):
    return r.last("rod.y_max") - r.last("rod.y_min")


def energy(r, row):
    return r["kinetic_energy"][row] + r["internal_energy"][row]


def drift(r, row=-1):
    """Relative change of kinetic + internal energy - external work + contact loss."""
    return (energy(r, row) - r["external_work"][row] + r["contact_loss"][row]) / energy(r, 0) - 1.0


def rod(cells, **more):
    h = RADIUS / cells
    settings = {"mesh/x/to": repr(h * round(0.016 / h)), "mesh/x/cells": round(0.016 / h),
                "mesh/y/to": repr(h * round(0.034 / h)), "mesh/y/cells": round(0.034 / h), **QUIET, **more}
    return harmos(DECK, settings)


def on_anvil(law):
    h = RADIUS / 8
    below = round(ANVIL_DEPTH / h)
    return rod(8, **{**SLIP, "mesh/y/from": -ANVIL_DEPTH, "mesh/y/cells": round(0.034 / h) + below,
                     "materials/anvil": law,
                     "bodies/anvil": f"{{material: anvil, shape: rectangle, center: [0.008, {-0.5 * ANVIL_DEPTH}], "
                                     f"size: [0.016, {ANVIL_DEPTH}]}}"})


def describe(name, r):
    print(f"  {name}: length {1e3 * length(r):.3f} mm, half-width {1e3 * r.last('rod.x_max'):.3f} mm, largest plastic strain "
          f"{r.last('rod.plastic_strain_max'):.2f}, y_min {1e3 * r.last('rod.y_min'):.4f} mm, "
          f"kinetic + internal energy {100 * (energy(r, -1) / energy(r, 0) - 1):.2f}%, drift {100 * drift(r):.3f}%, "
          f"cycles {r.summary['cycles']}")


def test_length_is_converged_at_eight_cells_and_energy_closes():
    coarse, fine = rod(8, **SLIP), rod(16, **SLIP)
    describe("8 cells", coarse)
    describe("16 cells", fine)
    check("length against 16 cells", abs(length(coarse) - length(fine)) / length(fine), 5e-3)
    check("energy drift", abs(drift(coarse)), 5e-3)
    h = RADIUS / 8
    check("energy of the stopped nodes", abs(-coarse.last("external_work") / energy(coarse, 0) - h / (2 * LENGTH)), 1e-6)
    check("energy ledger", coarse.summary["energy_error"], 1e-10)
    check("mass", coarse.summary["mass_error"], 1e-12)
    assert coarse.last("outflow_mass") == 0.0
    clean(coarse, fine)


def test_returned_kinetic_defect_keeps_the_energy():
    r = rod(8, **SLIP, **{"numerics/remap/return_kinetic_defect": "true"})
    check("energy drift", max(abs(drift(r, row)) for row in range(len(r["time"]))), 1e-4)
    clean(r)


def test_contact_wall_and_anvils_give_the_slip_wall_s_length():
    slip, contact = rod(8, **SLIP), rod(8)
    rigid, carbide = on_anvil(RIGID), on_anvil(CARBIDE)
    for name, r in (("slip wall", slip), ("contact wall", contact), ("rigid anvil", rigid), ("carbide anvil", carbide)):
        describe(name, r)
    for name, r in (("contact wall", contact), ("rigid anvil", rigid), ("carbide anvil", carbide)):
        check(f"length on the {name}", abs(length(r) - length(slip)) / length(slip), 0.01)
        check("energy drift", abs(drift(r)), 5e-3)
        check("energy ledger", r.summary["energy_error"], 1e-10)
    clean(slip, contact, rigid, carbide)


def test_lagrangian_runs_to_the_end_and_gives_the_same_length():
    euler, lagrange = rod(8), rod(8, kinematics="lagrangian")
    describe("xfem", euler)
    describe("lagrangian", lagrange)
    check("length against lagrangian", abs(length(euler) - length(lagrange)) / length(lagrange), 0.015)
    # Early on, before the foot is thin, both agree closely.
    early = {}
    for name, r in (("xfem", euler), ("lagrangian", lagrange)):
        row = next(i for i, t in enumerate(r["time"]) if t > 2.0e-5)
        early[name] = r["rod.y_max"][row]
    check("length at 20 us", abs(early["xfem"] - early["lagrangian"]) / early["lagrangian"], 3e-3)
    # Rows stand at a quarter and three quarters of a face: a node may dip while its neighbour lifts off.
    check("rod in the wall, cells", -min(lagrange["rod.y_min"]) / (RADIUS / 8), 0.05)
    check("energy ledger of lagrangian", lagrange.summary["energy_error"], 1e-10)
    clean(euler, lagrange)


if __name__ == "__main__":
    run(globals())
