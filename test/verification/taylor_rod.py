# SPDX-License-Identifier: BSD-3-Clause
"""Planar Taylor rod: convergence of the length, wall against second-material anvil, xfem against lagrangian, energy."""
from harness import check, clean, harmos, run

DECK = "taylor_rod/deck.yaml"
QUIET = {"output/fields/every_time": 0.0}


def length(r):
    return r.last("rod.y_max") - r.last("rod.y_min")


def rod(cells, **more):
    h = 0.0032 / cells
    settings = {"mesh/x/to": repr(h * round(0.012 / h)), "mesh/x/cells": round(0.012 / h),
                "mesh/y/to": repr(h * round(0.034 / h)), "mesh/y/cells": round(0.034 / h), **QUIET, **more}
    return harmos(DECK, settings)


def test_length_is_converged_at_eight_cells_and_energy_closes():
    coarse, fine = rod(8), rod(16)
    print(f"  length {length(coarse):.6f} {length(fine):.6f} m, width {coarse.last('rod.x_max'):.6f} {fine.last('rod.x_max'):.6f} m, "
          f"largest plastic strain {coarse.last('rod.plastic_strain_max'):.3f} {fine.last('rod.plastic_strain_max'):.3f}")
    check("length against 16 cells", abs(length(coarse) - length(fine)) / length(fine), 5e-3)
    e0 = coarse.first("kinetic_energy") + coarse.first("internal_energy")
    e1 = coarse.last("kinetic_energy") + coarse.last("internal_energy")
    check("energy drift", abs(e1 - e0) / e0, 5e-3)
    check("energy ledger", coarse.summary["energy_error"], 1e-10)
    check("mass", coarse.summary["mass_error"], 1e-12)
    clean(coarse, fine)


def test_returned_kinetic_defect_keeps_the_energy():
    r = rod(8, **{"numerics/remap/return_kinetic_defect": "true"})
    e0 = r.first("kinetic_energy") + r.first("internal_energy")
    drift = [abs(k + i + c - e0) / e0 for k, i, c in zip(r["kinetic_energy"], r["internal_energy"], r["contact_loss"])]
    check("energy drift less the contact loss", max(drift), 1e-4)
    clean(r)


def test_lagrangian_gives_the_same_length():
    euler = rod(8)
    lagrange = rod(8, kinematics="lagrangian")
    print(f"  length xfem {length(euler):.6f} lagrangian {length(lagrange):.6f} m")
    check("length against lagrangian", abs(length(euler) - length(lagrange)) / length(lagrange), 0.01)
    clean(euler, lagrange)


if __name__ == "__main__":
    run(globals())
