# SPDX-License-Identifier: BSD-3-Clause
"""Axisymmetric runs: uniform axial motion, uniform expansion (in the plane too), the cylindrical Noh problem, symmetry of a
spherical blast, an impact about the axis on several ranks, failure, friction and bonds there, the copper Taylor rod against
other codes, and what is refused.
"""
import math
import pathlib
import sys

import h5py
import numpy

from compare import same_on_ranks
from harness import EXAMPLE, check, clean, harmos, read_columns, run
from shocks import last_fields

sys.path.insert(0, str(EXAMPLE / "taylor_experiments"))
import shots

DECKS = pathlib.Path(__file__).resolve().parent / "decks"
ROD = "taylor_rod_axisymmetric/deck.yaml"
QUIET = {"output/fields/every_time": 0.0, "output/fields/at_end": "false"}


# Its rows with the ring ask for what it cannot do, radial motion: they had no diagonal, and all velocities became NaN.
def test_a_free_plunger_beside_a_ring_leaves_others_alone():
    for solver in "projected newton", "conjugate gradients", "row sums":
        fixed = harmos(DECKS / "plunger.yaml", {"bodies/plunger/motion": "fixed", "numerics/constraint": f"{{solver: {solver}}}"})
        r = harmos(DECKS / "plunger.yaml", {"numerics/constraint": f"{{solver: {solver}}}"})
        check(f"{solver}: energy ledger", r.summary["energy_error"], 1e-10)
        check("unconverged cycles", r.summary["unconverged_cycles"], 0)
        check("the plunger's momentum", abs(r.last("plunger.momentum_y")), 0.0)
        check("momentum of a block, against that beside a fixed plunger", abs(r.last("a.momentum_y") / fixed.last("a.momentum_y") - 1.0), 1e-9)
        clean(r, fixed)


def test_translation_along_the_axis_keeps_masses_volumes_and_pressure():
    r = harmos(DECKS / "ring_translation.yaml")
    exact = {"sphere": 2.0 / 3.0 * 0.27**3, "torus": math.pi * 0.17**2 * 0.6}
    exact["column"] = 0.5 * 0.9 - exact["sphere"] - exact["torus"]
    density = {"sphere": 7800.0, "torus": 7800.0, "column": 1000.0}
    for body, volume in exact.items():
        mass = density[body] * volume
        check(f"{body}: mass painted", abs(r.first(f"{body}.mass") / mass - 1.0), 1e-12)
        check(f"{body}: mass kept", max(abs(m / mass - 1.0) for m in r[f"{body}.mass"]), 1e-12)
        check(f"{body}: volume kept", max(abs(v / volume - 1.0) for v in r[f"{body}.volume"]), 1e-11)
    check("axial momentum", r.summary["momentum_error"], 1e-13)
    kinetic = 0.5 * sum(density[b] * v for b, v in exact.items()) * 300.0**2
    check("kinetic energy", max(abs(k / kinetic - 1.0) for k in r["kinetic_energy"]), 1e-12)
    check("internal energy over kinetic", max(abs(e) for e in r["internal_energy"]) / kinetic, 1e-12)
    clean(r)


def noh(cells):
    """Errors of the density behind the shock (exact 16 at r = 0.1) and before it (1 + t/r = 3 at r = 0.3)."""
    r = harmos(DECKS / "noh.yaml", {"mesh/x/cells": cells, "mesh/y/cells": 3 * cells // 100, **QUIET})
    probes = read_columns(r.directory / "probes.csv")
    density = dict(zip(probes["name"], probes["density"]))  # the last of each
    print(f"  {cells} cells: density {density['behind']:.3f} behind, {density['before']:.4f} before")
    check("energy", r.summary["energy_error"], 1e-12)
    clean(r)
    return abs(density["behind"] / 16.0 - 1.0), abs(density["before"] / 3.0 - 1.0)


def test_noh_problem_converges_to_its_plateau():
    coarse, fine = noh(100), noh(200)
    check("behind, 100 cells", coarse[0], 0.12)
    check("behind, 200 cells", fine[0], 0.03)
    check("before, 200 cells", fine[1], 0.01)


def test_sod_along_the_axis_is_sod_in_the_plane_in_every_column():
    # Masses lumped by the shape functions: along z the nodes on the axis are driven like all others, and radial fluxes are zero.
    tube = {"mesh/x": "{from: 0.0, to: 0.04, cells: 8}", "mesh/y": "{from: 0.0, to: 1.0, cells: 200}",
            "bodies/left": "{material: gas, shape: rectangle, center: [0.0, 0.25], size: [1.0, 0.5], density: 1.0, pressure: 1.0}",
            "bodies/right": "{material: gas, shape: rectangle, center: [0.0, 0.75], size: [1.0, 0.5], density: 0.125, pressure: 0.1}",
            "output/fields/every_time": 0.0, "run/max_cycles": 150}
    one_field, first_order = {"bodies/right/join": "left"}, {"numerics/remap/order": 1}
    for name, more, bound in (("first order", {**one_field, **first_order}, 1e-12), ("second order", one_field, 1e-10),
                              ("two fields in contact, first order", first_order, 1e-9)):
        ring = harmos("shocks/sod.yaml", {"geometry": "axisymmetric", **tube, **more})
        plane = harmos("shocks/sod.yaml", {**tube, **more})
        density, flat = (last_fields(r)[2].reshape(200, 8) for r in (ring, plane))
        assert abs(flat - 1.0).max() > 0.5 and ring.summary["cycles"] == 150
        check(f"{name}: density of the columns, apart", float(abs(density - density[:, :1]).max()), bound)
        check(f"{name}: density, apart from the planar one", float(abs(density - flat).max()), bound)
        clean(ring, plane)


def test_cylinder_and_ball_of_cold_gas_expand_uniformly():
    """v = R / t0, no pressure: rho = (1 + t / t0)^-d in every cell, the surface at R (1 + t / t0)."""
    for geometry, dimensions in (("planar", 2), ("axisymmetric", 3)):
        r = harmos(DECKS / "expansion.yaml", {"geometry": geometry})
        exact = 2.0**-dimensions
        x, _, density, _ = last_fields(r)
        inside = numpy.hypot(x[:, 0], x[:, 1]) < 0.6
        beside = density[inside & (x.min(axis=1) < 0.02)] / exact
        with h5py.File(sorted(r.directory.glob("fields_*.h5"))[-1]) as file:
            surface = numpy.hypot(*file["/interface/vertex"][:].reshape(-1, 2, 2).mean(axis=1).T)
        print(f"  {geometry}: density over the exact one {density[inside].min() / exact:.4f} to {density[inside].max() / exact:.4f}, beside axis and "
              f"planes of symmetry {beside.min():.4f} to {beside.max():.4f}; surface at {surface.min():.4f} to {surface.max():.4f}")
        check("density", float(abs(density[inside] / exact - 1.0).max()), 0.015)
        check("surface, cells off", float(abs(surface - 0.8).max()) / 0.02, 0.6)
        check("mass", r.summary["mass_error"], 1e-13)
        clean(r)


def test_spherical_blast_stays_a_sphere():
    """Of a sphere's excess pressure the second moments are in the ratio of integral r^2 / 2 to integral z^2 = 1, and the front
    of the hot gas is as far from the centre across the axis as along it."""
    r = harmos(DECKS / "blast.yaml", {"output/fields/at_end": "true"})
    with h5py.File(sorted(r.directory.glob("fields_*.h5"))[-1]) as file:
        centre = file["/nodes/position"][:][file["/cells/connectivity"][:]].mean(axis=1)
        excess = (file["/cells/pressure"][:] - 0.1) * centre[:, 0]
    across, along = (0.5 * excess * centre[:, 0] ** 2).sum(), (excess * centre[:, 1] ** 2).sum()
    print(f"  front of the hot gas: r = {r.last('ball.x_max'):.4f}, z = {r.last('ball.y_max'):.4f}")
    check("asymmetry of the pressure's second moments", abs(across / along - 1.0), 5e-3)
    check("asymmetry of the hot gas' front", abs(r.last("ball.x_max") / r.last("ball.y_max") - 1.0), 5e-3)
    check("energy", r.summary["energy_error"], 1e-12)
    clean(r)


def test_impact_about_the_axis_keeps_axial_momentum_and_is_the_same_on_any_number_of_ranks():
    common = {"run/max_cycles": 60, "output/checkpoint/at_end": "true", "output/fields/at_end": "false"}
    one = harmos(DECKS / "ring_impact.yaml", common)
    check("axial momentum", one.summary["momentum_error"], 1e-13)
    check("mass", one.summary["mass_error"], 1e-13)
    assert max(one["plate.momentum_y"]) > 0.01
    same_on_ranks(one, DECKS / "ring_impact.yaml", common)
    clean(one)


def test_gas_about_the_axis_is_the_same_on_any_number_of_ranks():
    """Wide pure regions: nodes gather by packs in one place and one by one in another, as the ranks cut them."""
    common = {"run/max_cycles": 20, "output/checkpoint/at_end": "true", "output/fields/at_end": "false"}
    one = harmos(DECKS / "blast.yaml", common)
    same_on_ranks(one, DECKS / "blast.yaml", common)
    clean(one)


def test_what_fails_about_the_axis_keeps_the_ledgers_and_is_the_same_on_any_number_of_ranks():
    common = {"materials/aluminium/tension_limit": 0.0, "materials/aluminium/spall_stress": 1.2e9,
              "output/checkpoint/at_end": "true", "output/fields/at_end": "false"}
    one = harmos(DECKS / "ring_impact.yaml", common)
    check("axial momentum", one.summary["momentum_error"], 1e-13)
    check("mass", one.summary["mass_error"], 1e-13)
    check("energy", one.summary["energy_error"], 1e-12)
    share = one.last("plate.failed_mass") / one.last("plate.mass")
    print(f"  {100 * share:.1f} per cent of the plate has failed")
    assert 0.01 < share < 0.9 and one.last("sphere.failed_mass") > 0.0
    same_on_ranks(one, DECKS / "ring_impact.yaml", common)
    clean(one)


def test_a_sleeve_drawn_along_a_pressed_rod_does_the_work_of_coulomb_s_law():
    # Force per radian mu p R L on the rod's side; its ends slip on walls, across which nothing moves.
    pressure, coefficient, radius, length, speed = 1.0e5, 0.1, 0.5, 2.0, 1.0
    # At the ends nodes that the walls hold bear their part of it: without theirs `segment ends` lacked a sixteenth.
    for cells, placement in ((8, "midpoint"), (16, "midpoint"), (8, "segment ends"), (8, "gauss points"), (8, "mortar")):
        r = harmos(DECKS / "sleeve.yaml", {"mesh/x/cells": cells, "mesh/y/cells": 2 * cells, "numerics/constraint/placement": placement})
        exact = coefficient * pressure * radius * length * speed * r.time_of_velocities()
        work = r.last("external_work")
        print(f"  {cells} cells, {placement}: work {work:.4f} J/rad, exact {exact:.4f}")
        check("work", abs(work / exact - 1.0), 2e-3)
        check("energy ledger", r.summary["energy_error"], 1e-9)
        clean(r)


def test_a_bond_around_the_axis_breaks_at_its_strength():
    # Uniaxial strain; the ring leaves a plate at rest with V: rho c_L V, and what the first steps overshoot.
    rho, c, g, speed = 7800.0, 4600.0, 80.0e9, 10.0
    tension = rho * math.sqrt(c * c + 4.0 * g / (3.0 * rho)) * speed
    for way in ("{}", "{placement: gauss points}", "{placement: segment ends}", "{placement: vital vertices}", "{placement: mortar}", "{solver: conjugate gradients}"):
        for strength, broken in ((1.2, 0), (0.95, 8)):
            r = harmos(DECKS / "bonded_ring.yaml", {"interactions/tensile_strength": strength * tension, "numerics/constraint": way})
            print(f"  {way}: strength {strength} of rho c V: {r.summary['broken_bonds']} bonds of 8 broke")
            assert r.summary["broken_bonds"] == broken
            check("axial momentum", r.summary["momentum_error"], 1e-12)
            clean(r)


def test_rigid_ball_on_the_axis_moves_along_it_and_action_is_reaction():
    settings = {"materials/ball": "{eos: rigid, density: 7800.0}", "bodies/sphere/material": "ball",
                "bodies/sphere/motion": "free", "run/max_cycles": 100, **QUIET}
    r = harmos(DECKS / "ring_impact.yaml", settings)
    check("ball's mass", abs(r.first("sphere.mass") / (7800.0 * 2.0 / 3.0 * 0.004**3) - 1.0), 1e-12)
    check("ball's radial momentum", max(abs(p) for p in r["sphere.momentum_x"]), 0.0)
    check("axial momentum", r.summary["momentum_error"], 1e-12)
    assert max(r["plate.momentum_y"]) > 0.01
    clean(r)


def test_copper_rod_has_the_length_and_radius_of_other_codes():
    r = harmos(ROD, QUIET)
    length, radius = r.last("rod.y_max") - r.last("rod.y_min"), r.last("rod.x_max")
    print(f"  length {1e3 * length:.3f} mm, radius {1e3 * radius:.3f} mm, largest plastic strain "
          f"{r.last('rod.plastic_strain_max'):.2f}, cycles {r.summary['cycles']}")
    assert 21.4e-3 <= length <= 21.7e-3
    assert 7.0e-3 <= radius <= 7.2e-3
    check("mass", r.summary["mass_error"], 1e-13)
    check("energy", r.summary["energy_error"], 1e-12)
    clean(r)


def test_rods_of_wilkins_and_guinan_have_the_measured_lengths():
    every = {shot["shot"]: shot for shot in shots.rows(EXAMPLE / "taylor_experiments/shots.csv")}
    for name, law in (("Cu 153", "johnson-cook"), ("6061 283", "johnson-cook"), ("6061 283", "steinberg-guinan")):
        r = harmos("taylor_experiments/deck.yaml", {**shots.settings(every[name], law, 8), **QUIET})
        length, _, _ = shots.measure(r.directory)
        print(f"  {name} m/s, {law}: {length:.2f} mm, measured {every[name]['final_length']} mm")
        check(f"{name}, {law}", abs(length / float(every[name]["final_length"]) - 1.0), 0.02)
        clean(r)


def test_rods_of_johnson_and_cook_have_the_measured_lengths_with_constants_from_cylinder_impacts():
    every = {shot["shot"]: shot for shot in shots.rows(EXAMPLE / "taylor_experiments/shots.csv")}
    for name, wide in (("OFHC 130", 0.15), ("OFHC 190", 0.05)):  # the foot of the slow one: README of the scene
        r = harmos("taylor_experiments/deck.yaml", {**shots.settings(every[name], "johnson-cook-cylinders", 8), **QUIET})
        length, diameter, _ = shots.measure(r.directory)
        print(f"  {name} m/s: {length:.2f} mm, {diameter:.2f} mm wide, measured {every[name]['final_length']} and {every[name]['final_diameter']}")
        check(f"{name}, length", abs(length / float(every[name]["final_length"]) - 1.0), 0.02)
        check(f"{name}, diameter", abs(diameter / float(every[name]["final_diameter"]) - 1.0), wide)
        clean(r)


def test_friction_narrows_the_foot_alike_on_a_wall_and_on_a_rigid_anvil():
    rod = {"mesh/x/cells": 18, "mesh/y/cells": 42, "bodies/rod/velocity": "[0.0, -130.0]", "run/end_time": 6.0e-5, **QUIET}
    h = 26.67e-3 / 42
    anvil = {"mesh/y/from": -8 * h, "mesh/y/cells": 50, "materials/anvil": "{eos: rigid, density: 8000.0}",
             "bodies/anvil": f"{{material: anvil, shape: rectangle, center: [0.0, {-4 * h}], size: [0.03, {8 * h}]}}",
             "boundaries/bottom/type": "slip wall"}
    runs = [harmos("taylor_experiments/deck.yaml", {**rod, **more}) for more in
            ({}, {"boundaries/bottom/friction": 0.3}, anvil,
             {**anvil, "interactions/default": "friction", "interactions/coefficient": 0.3})]
    width = [r.last("rod.x_max") for r in runs]
    length = [r.last("rod.y_max") - r.last("rod.y_min") for r in runs]
    print("  radius [mm], wall and anvil, smooth and rough:", *(f"{1e3 * w:.3f}" for w in width))
    assert width[1] < 0.95 * width[0]
    check("radius, smooth", abs(width[2] / width[0] - 1.0), 0.005)
    check("radius, rough", abs(width[3] / width[1] - 1.0), 0.02)  # 0.4% at 12 cells
    for wall, on_anvil in ((0, 2), (1, 3)):
        check("length", abs(length[on_anvil] / length[wall] - 1.0), 0.003)
    clean(*runs)


def test_what_has_no_meaning_about_an_axis_is_refused():
    for settings, words in ((("mesh/x/from", -0.001), "mesh/x/from"), (("boundaries/left/type", "outflow"), "axis"),
                            (("gravity", "[1.0, 0.0]"), "radial"), (("bodies/rod/angular_velocity", 1.0), "ring")):
        r = harmos(ROD, dict([settings]), expect=2)
        assert words in r.text, r.text
        assert len(r.text.strip().splitlines()) == 1, r.text


if __name__ == "__main__":
    run(globals())
