# SPDX-License-Identifier: BSD-3-Clause
"""Slivers neither shorten the time step nor blow up; the stable Courant number of xfem is that of single."""
import tempfile
from math import pi

from harness import ROOT, check, clean, harmos, run
from contact_iterations import iterations_of_strip
from sliding_block import SQUEEZE
from stability_atlas import BLOCKS, METHODS, OBLIQUE, block, deviation, mean_step, oblique, ring

DECK = ROOT / "test/verification/decks/sliver.yaml"
VOID_STAYS = {"numerics/remap/close_void_beside_gas": 0.0}


def box(sliver, **more):
    """The interface `sliver` of a cell beyond the cell face at x = 8: the left block reaches into the next cells."""
    x = 8.0 + sliver
    settings = {"bodies/left/center": f"[{x / 2!r}, 2.0]", "bodies/left/size": f"[{x!r}, 4.0]",
                "bodies/right/center": f"[{(16.0 + x) / 2!r}, 2.0]", "bodies/right/size": f"[{16.0 - x!r}, 4.0]", **more}
    return harmos(DECK, settings)


def test_sliver_runs_ten_thousand_cycles_without_a_shorter_step():
    plain = box(0.0)
    start = {"run/max_cycles": 5, "output/history/every_cycles": 1}
    plain_start = box(0.0, **start)
    for merge in (0.0, 1e-6):  # (the material beside a sliver of 1e-10 has a gradient that is off the cell's by as much)
        r = box(1e-10, **{"numerics/remap/merge_below": merge})
        first = box(1e-10, **{"numerics/remap/merge_below": merge, **start})
        check(f"first time steps against no sliver, merging below {merge}",
              max(abs(a / b - 1.0) for a, b in zip(first["dt"][1:], plain_start["dt"][1:])), 1e-9)
        check("least time step against no sliver", abs(min(r["dt"][1:]) / min(plain["dt"][1:]) - 1.0), 1e-3)
        check("kinetic energy against its first peak", max(r["kinetic_energy"][50:]) / max(r["kinetic_energy"][:20]), 1.0)
        check("mass", r.summary["mass_error"], 1e-11)
        check("momentum", r.summary["momentum_error"], 1e-11)
        check("energy ledger", r.summary["energy_error"], 1e-10)
        clean(r, first)
    clean(plain, plain_start)


def test_courant_number_near_one_is_stable_with_slivers_as_in_single():
    # Without viscosity nothing hides an instability: kinetic energy would grow by orders of magnitude.
    bare = {"numerics/linear_viscosity": 0.0, "numerics/quadratic_viscosity": 0.0, "numerics/hourglass_viscosity": 0.0,
            "numerics/courant": 0.95, "run/max_cycles": 2000}
    for kinematics in ("xfem", "single"):
        for merge in (0.0, 1e-6):
            r = box(1e-12, **{"kinematics": kinematics, "numerics/remap/merge_below": merge, **bare})
            stored = 0.5 * 0.001**2 * 32.0
            check(f"{kinematics}, merging below {merge}: largest kinetic energy over the stored one", max(r["kinetic_energy"]) / stored, 1.0)
            clean(r)


def test_oblique_interfaces_leave_a_step_that_is_stable_and_hardly_shorter():
    # An unstable run counts as a step of zero: the fluids' at 45 degrees when parts of cells were not looked at.
    for angle, shear in OBLIQUE:
        settings, left_area, wave = oblique(angle, shear)
        step = mean_step("multipliers", 0.95, {**settings, "run/max_cycles": 1000}, left_area, wave)
        check(f"{angle:.0f} degrees, shear modulus {shear}: mean step over the time of a wave through a cell, short of 0.95",
              0.95 - step, 0.015)


def ringing_block(kinematics, geometry, elastic, size, fills_the_mesh=False):
    """Largest kinetic energy of a block that rings at Courant 0.95, over what it had stored."""
    width, height = size
    ring = geometry == "axisymmetric"
    settings = {"kinematics": kinematics, "geometry": geometry,
                "bodies/block/center": f"[{0.5 * width + (0.0 if ring else 1.0)}, {0.5 * height - height // 2}]", "bodies/block/size": f"[{width}, {height}]"}
    if ring:
        settings["boundaries/left"] = "{type: slip wall}"
    if elastic:
        settings.update({"materials/block/strength": "elastic", "materials/block/shear_modulus": 0.3})
    if fills_the_mesh:
        settings.update({"mesh/x": f"{{from: 0.0, to: {width}.0, cells: {width}}}", "mesh/y": f"{{from: 0.0, to: {height}.0, cells: {height}}}",
                         "bodies/block/center": f"[{0.5 * width}, {0.5 * height}]"})
    r = harmos(ROOT / "test/verification/decks/ringing_block.yaml", settings)
    clean(r)
    return max(r["kinetic_energy"]) / (0.5 * 1e-4**2 * width * height * (0.5 * width if ring else 1.0))


def test_free_edges_of_whole_cells_are_stable_near_courant_one():
    # Without shear strength a single cell is stable to 0.71 (0.63 on an axis), a strip to 0.79, a block to 0.90. With all of 0.95
    # kinetic energies came to 1e2 (block) to 1e8 times what is stored.
    cases = [(kinematics, geometry, elastic, size, False) for kinematics in ("xfem", "lagrangian") for geometry in ("planar", "axisymmetric")
             for elastic in (False, True) for size in ((1, 1), (1, 8), (3, 6))]
    cases += [("single", geometry, False, (1, 8), False) for geometry in ("planar", "axisymmetric")]
    cases += [("xfem", geometry, False, size, True) for geometry in ("planar", "axisymmetric") for size in ((1, 1), (1, 4))]
    for kinematics, geometry, elastic, size, fills in cases:
        check(f"{kinematics}, {geometry}, {'elastic' if elastic else 'fluid'}, {size[0]} x {size[1]} cells{', all of the mesh' if fills else ''}: "
              "kinetic energy over the stored one", ringing_block(kinematics, geometry, elastic, size, fills), 1.1)


def test_splinters_gain_no_energy_at_long_steps():
    # Unstable steps took 0.44 and 1.15 times the energy of the scene into the disc (0.9), stable ones at most 0.15.
    for geometry in "planar", "axisymmetric":
        for courant in 0.9, 0.99:
            r = harmos(ROOT / "test/verification/decks/disc_in_a_ring.yaml", {
                "geometry": geometry, "numerics/courant": courant, "run/max_cycles": 300, "output/history/every_cycles": 1,
                "output/fields/every_time": 0.0, "output/fields/at_end": "false"})
            check(f"{geometry}, Courant {courant}: kinetic energy of the disc over the energy of the scene",
                  max(r["disc.kinetic_energy"]) / (r.first("kinetic_energy") + r.first("internal_energy")), 0.2)
            clean(r)


def test_vital_vertices_keep_a_uniform_pressure_at_an_oblique_interface():
    # Exact: no deviation. At 35 degrees the line passes nodes at 2e-4 of a cell: the tips there are merged, and lose their pressure.
    for angle, bound in ((0.0, 1e-6), (20.0, 1e-6), (35.0, 0.08)):
        check(f"vital vertices, {angle:.0f} degrees: deviation of the tractions", deviation("vital vertices", angle), bound)


def gases(cut_cell_stress, height=0.487, **more):
    """Largest kinetic over internal energy of one gas in two fields at rest, parted at 20 degrees, in 2 ms (11 times through)."""
    air = "{eos: ideal gas, density: 1.2, gamma: 1.4, internal_energy: 2.0e5}"
    deck = ["harmos:", "  kinematics: xfem", "  mesh: {x: {from: 0.0, to: 1.0, cells: 30}, y: {from: 0.0, to: 1.0, cells: 30}}",
            f"  materials: {{air: {air}}}", "  bodies:",
            "    lower: {material: air, shape: rectangle, center: [0.5, 0.5], size: [1.0, 1.0]}",
            f"    upper: {{material: air, shape: half-plane, point: [0.5, {height}], normal: [0.342, 0.9397], cut: true, density: 1.2, "
            "pressure: 96000.0}",
            "  run: {end_time: 0.002}", "  output: {history: {every_cycles: 1}, fields: {every_time: 0.0}}"]
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        file.write("\n".join(deck) + "\n")
        file.flush()
        r = harmos(file.name, {"numerics/cut_cell_stress": cut_cell_stress, **more})
    check("energy ledger", r.summary["energy_error"], 1e-10)
    clean(r)
    return max(kinetic / internal for kinetic, internal in zip(r["kinetic_energy"], r["internal_energy"]))


def test_gases_of_one_pressure_rest_beside_an_oblique_interface():
    # Exact: nothing moves. Forces along the cells' mean gradients are no balance for the tractions and drive jets.
    check("kinetic over internal energy", gases("fluids"), 1e-15)
    for height in (0.467, 0.497):
        check(f"about an axis, {height} m", gases("fluids", height, geometry="axisymmetric"), 1e-15)
    # At this height a cell on the axis holds a sliver of 6e-4, which starts with 1 m/s: what is left of it later is the
    # less the more the remap smears.
    check("about an axis, 0.487 m", gases("fluids", geometry="axisymmetric"), 6e-6)
    driven = gases("cell mean")
    print(f"  cells' mean gradients: {driven:.1e}")
    assert driven > 1e-3


def test_gases_rest_at_each_others_corners():
    # Without tractions for what rows leave of the pressure 1e-3 of the internal energy and more drives jets along the interface in 5 ms.
    for inner in "eos: ideal gas, density: 1.2, gamma: 1.4", "eos: ideal gas, density: 0.17, gamma: 1.66", "eos: stiffened, density: 1000.0, sound_speed: 1500.0":
        for shape in "rectangle, size: [0.7, 0.7], center: [0.2, 0.2], angle: 33.0", "disc, radius: 0.4, center: [0.213, 0.197]":
            for more, end_time in ((VOID_STAYS, 5e-3), ({}, 1e-2)):
                r = harmos(ROOT / "test/verification/decks/gas_in_a_box.yaml", {
                    "boundaries": "{}", "materials": f"{{air: {{eos: ideal gas, density: 1.2, gamma: 1.4}}, other: {{{inner}}}}}",
                    "bodies": "{gas: {material: air, shape: rectangle, center: [0.2, 0.2], size: [1.6, 1.6], pressure: 1.0e5}, "
                              f"other: {{material: other, shape: {shape}, pressure: 1.0e5, cut: true}}}}",
                    "mesh/x/cells": 40, "mesh/y/cells": 40, "run/end_time": end_time, **more})
                check(f"{inner}, {shape}, in air, {end_time:.0e} s: kinetic over internal energy", max(r["kinetic_energy"]) / r.first("gas.internal_energy"), 1e-15)
                clean(r)


def test_air_stays_where_it_is_over_a_block_that_begins_to_float():
    # Void that opened between air and wood was held open, up to 0.005 of a cell, and air ran along it: 0.26 to 2.4 J/m; then, until air
    # fills what opens, 3e-4 to 0.17.
    # The last place has its sides on cell faces: films of air that rays could not pass gave 21 J/m there.
    for center in "[0.307, 0.437]", "[0.311, 0.433]", "[0.318, 0.4355]", "[0.3, 0.43]":
        for more, bound in ((VOID_STAYS, 0.1), ({}, 2e-3)):
            r = harmos(ROOT / "test/verification/decks/floating_block.yaml", {"bodies/block/center": center, **more})
            check(f"block at {center}{', void stays' if more else ''}: kinetic energy of the air [J/m]", max(r["air.kinetic_energy"]), bound)
            check("energy ledger", r.summary["energy_error"], 1e-10)
            clean(r)


def test_a_block_floats_in_still_air():
    # Until tractions were no larger than the cells around bear, and gas did the work of what it fills, 1.7 kJ/m were taken by 0.116 s (sides on
    # cell faces), or it ended early. Until what drives a tip along its interface was what acts through its opening, four of twenty places were
    # stirred by 2e-3 to 0.8 J/m, by last digits: hence the neighbours of the first.
    for center in "[0.3, 0.43]", "[0.30000000000007, 0.43]", "[0.30000000000009, 0.43]", "[0.311, 0.433]":
        r = harmos(ROOT / "test/verification/decks/floating_block.yaml", {"bodies/block/center": center, "run/end_time": 0.12})
        check(f"block at {center}: kinetic energy of the air [J/m]", max(r["air.kinetic_energy"]), 1e-2)
        check(f"block at {center}: energy that contact takes or gives over that of the scene", max(map(abs, r["contact_loss"])) / r.last("internal_energy"), 2e-5)
        check(f"block at {center}: overlap", r.last("overlap_volume"), 1e-4)
        check("energy ledger", r.summary["energy_error"], 1e-10)
        clean(r)


def test_fluids_that_ring_gain_nothing_at_long_steps():
    # Of the stored energy 0.45 is kinetic at most. With the mean of both sides' pressures in the tractions 46 and 4; at 30 degrees 1,300, where
    # void of half a hundredth of a cell, which opened and closed from step to step, made edges straight.
    for method, angle, courant, bound in (("vital vertices", 20.0, 0.95, 0.6), ("mortar", 20.0, 0.95, 0.6), ("multipliers", 20.0, 0.95, 0.6),
                                          ("mortar", 30.0, 0.9, 1.0), ("mortar", 30.0, 0.95, 1.0)):
        settings, left_area, _ = oblique(angle, 0.0)
        r, most = ring(method, courant, settings, left_area)
        check(f"{method}, {angle:.0f} degrees, Courant {courant}: kinetic energy over the stored one", most, bound)
        clean(r)


def test_tied_blocks_that_ring_lose_nothing_to_contact():
    # With a row for each piece of a line beside a wedge of 1e-6 of a cell of void 1% and 6% of what was stored.
    for angle in 20.0, 70.0:
        settings, left_area, _ = oblique(angle, 0.3)
        r, most = ring("multipliers", 0.5, {**settings, "interactions": "{default: bonded}"}, left_area)
        check(f"{angle:.0f} degrees: energy that contact takes or gives over the stored one", max(map(abs, r["contact_loss"])) / (0.5 * 0.001**2 * left_area), 1e-3)
        check(f"{angle:.0f} degrees: multipliers, most over least", max(r["multipliers"]) / min(r["multipliers"][1:]), 1.2)
        clean(r)


# At 35 degrees the line passes nodes at 2e-4 of a cell: the tips there are merged with their neighbours, and lose their pressure.
def test_gas_rests_at_the_corners_of_solids():
    # With chords in the corners' cells gas left a box through its corners (3.4e-4 to 0.14 of its volume in 2 ms), and a square in air
    # got 195 J/m in 10 ms.
    for angle, cells in ((0.0, 16), (10.0, 16), (25.0, 16), (25.0, 64)):
        r = harmos(ROOT / "test/verification/decks/gas_in_a_box.yaml", {
            "bodies/box/angle": angle, "bodies/gas/angle": angle, "mesh/x/cells": cells, "mesh/y/cells": cells})
        what = f"box at {angle:.0f} degrees, {cells} cells"
        check(f"{what}: volume of the gas, off (walls give 2e-4)", abs(r.last("gas.volume") / r.first("gas.volume") - 1.0), 4e-4)
        check(f"{what}: kinetic energy of the gas over its internal one", max(r["gas.kinetic_energy"]) / r.first("gas.internal_energy"), 1e-8)
        clean(r)
    r = harmos(ROOT / "test/verification/decks/gas_in_a_box.yaml", {
        "geometry": "axisymmetric", "mesh/x": "{from: 0.0, to: 0.8, cells: 20}", "mesh/y/cells": 40, "boundaries/left": "{type: slip wall}",
        "bodies/gas/center": "[0.0, 0.013]", "bodies/box/center": "[0.0, 0.013]"})
    check("can about an axis: volume of the gas, off", abs(r.last("gas.volume") / r.first("gas.volume") - 1.0), 4e-4)  # 6.2 before
    clean(r)
    # With slip walls around all is at one pressure. Corners in mid-cell, near a face (the other body in two parts behind), beside slivers.
    square = "rectangle, size: [0.7, 0.7]"
    for shape, center, angle, end_time in ((square, "[0.2, 0.2]", 33.0, 2e-2), (square, "[0.21, 0.18]", 20.0, 2e-3), (square, "[0.213, 0.197]", 20.0, 2e-2),
                                           (square, "[0.21, 0.215]", 0.0, 2e-3), ("disc, radius: 0.4", "[0.213, 0.197]", 0.0, 2e-3)):
        r = harmos(ROOT / "test/verification/decks/gas_in_a_box.yaml", {
            "boundaries": "{}",
            "bodies": "{gas: {material: air, shape: rectangle, center: [0.2, 0.2], size: [1.6, 1.6], pressure: 1.0e5}, box: {material: steel, "
                      f"shape: {shape}, center: {center}, angle: {angle}, pressure: 1.0e5, cut: true}}}}",
            "mesh/x/cells": 40, "mesh/y/cells": 40, "run/end_time": end_time})
        check(f"{shape} in air, {angle:.0f} degrees: kinetic energy over the gas's internal one", max(r["kinetic_energy"]) / r.first("gas.internal_energy"), 1e-15)
        clean(r)


def test_gas_rests_beside_solids_and_gases_about_an_axis():
    # Without tractions up to 2e-4; without those in the cells on the axis and between two fluids spheres 4e-6 and 6e-5, a torus of gas 1.2e-4.
    other = "{eos: ideal gas, density: 0.17, gamma: 1.66}"
    sphere, torus = "disc, radius: 0.25, center: [0.0, 0.213]", "disc, radius: 0.25, center: [0.413, 0.213]"
    for law, shape in (("steel", "rectangle, center: [0.413, 0.213], size: [0.4, 0.4], angle: 20.0"), ("steel", torus), ("steel", sphere),
                       ("steel", "polygon, points: [0.0, -0.2, 0.4, 0.31, 0.0, 0.31]"), ("other", torus), ("other", sphere)):
        r = harmos(ROOT / "test/verification/decks/gas_in_a_box.yaml", {
            "geometry": "axisymmetric", "boundaries": "{}", "mesh/x": "{from: 0.0, to: 0.8, cells: 20}", "mesh/y/cells": 40, "run/end_time": 4e-3,
            **({"materials/other": other} if law == "other" else {}),
            "bodies": "{gas: {material: air, shape: rectangle, center: [0.2, 0.2], size: [1.6, 1.6], pressure: 1.0e5}, "
                      f"box: {{material: {law}, shape: {shape}, pressure: 1.0e5, cut: true}}}}"})
        check(f"{law}, {shape}: kinetic energy over the gas's internal one", max(r["kinetic_energy"]) / r.first("gas.internal_energy"), 1e-15)
        clean(r)


def given_by_contact(r):
    """Sum of what contact gave in the cycles in which it gave energy [J/m]."""
    loss = r["contact_loss"]
    return sum(max(0.0, before - after) for before, after in zip(loss, loss[1:]))


def test_gas_that_is_squeezed_to_nothing_gains_no_energy():
    # Remnants beside the axis slide along the liner at a speed that their own heat allows. With tractions up to slips of 0.5 sqrt(p / density)
    # contact gave them 1e11 times the energy of the scene (planar).
    for geometry in "planar", "axisymmetric":
        r = harmos(ROOT / "test/verification/decks/collapse.yaml", {"geometry": geometry})
        check(f"{geometry}: energy that contact gave over that of the scene", given_by_contact(r) / r.first("internal_energy"), 1e-3)
        clean(r)


def test_gas_that_bodies_squeeze_to_films_ends_no_run():
    # Thin gas that kept its heat: 1,314 cycles to 26 ms and -17 kJ from contact; steps of 1e-8 s; 1,097 cycles to 30 ms. Now at most 1,056.
    for of_a, of_b in (([0.0017, 0.0151], [-0.0213, 0.0269]), ([0.0, 0.0], [0.0, 0.0]), ([0.005, 0.02], [-0.01, 0.0])):
        r = harmos(ROOT / "test/verification/decks/discs_in_gas.yaml", {"bodies/a/shift": str(of_a), "bodies/b/shift": str(of_b), "run/max_cycles": 2500},
                   expect=None)
        check(f"discs at {of_a}, {of_b}: end time, short of", 0.05 - r.last("time"), 1e-9)
        check(f"discs at {of_a}, {of_b}: energy that contact gave over the kinetic energy at the start", given_by_contact(r) / r.first("kinetic_energy"), 5e-3)
        clean(r)


def test_gas_between_bodies_that_collide_stays_warm():
    # With the viscosity of whole cells in films, whose nodes are faster than their sides as a cell is thicker, gas lost up to 5 times the
    # energy of the scene in a cycle, to motion; at 1000 m/s a quarter.
    for speed in 3000.0, 1000.0:
        r = harmos(ROOT / "test/verification/decks/impact_through_air.yaml", {
            "bodies/ball/velocity": f"[0.0, {-speed}]", "run/end_time": 33.0e-3 / speed, "run/max_cycles": 600})
        total = r.first("kinetic_energy") + r.first("internal_energy")
        check(f"{speed:.0f} m/s: internal energy that the gas lost, of the scene's", -min(e - r.first("gas.internal_energy") for e in r["gas.internal_energy"]) / total, 1e-4)
        check(f"{speed:.0f} m/s: kinetic energy of the gas, of the scene's", max(r["gas.kinetic_energy"]) / total, 0.03)
        check(f"{speed:.0f} m/s: end time, short of", 33.0e-3 / speed - r.last("time"), 1e-12)
        assert not any("equation of state" in text for text in r.summary["warnings"]), r.summary["warnings"]
        clean(r)


def test_a_disc_sets_no_more_air_in_motion_than_it_displaces():
    # In an unbounded fluid rho pi a^2 V^2 / 2. Voids of 1e-8 of a cell and more, which nothing closed, gave 1.5 and 3 J/m after 10 and 20 ms,
    # whatever the velocity, and overlaps took a hundredth of the disc's volume.
    for speed, end_time in ((0.001, 1e-2), (0.5, 1e-2), (5.0, 2e-2)):
        r = harmos(ROOT / "test/verification/decks/gas_in_a_box.yaml", {
            "boundaries": "{}", "mesh/x": "{from: 0.0, to: 1.0, cells: 40}", "mesh/y": "{from: 0.0, to: 1.0, cells: 40}",
            "materials/steel/sound_speed": 150.0, "materials/steel/shear_modulus": 6e7,
            "bodies": "{gas: {material: air, shape: rectangle, center: [0.5, 0.5], size: [1.0, 1.0], pressure: 1.0e5}, box: {material: steel, "
                      f"shape: disc, center: [0.513, 0.6], radius: 0.1, pressure: 1.0e5, cut: true, velocity: [0.0, {-speed}]}}}}",
            "run/end_time": end_time})
        check(f"{speed} m/s: kinetic energy of the air over what an unbounded fluid has",
              max(r["gas.kinetic_energy"]) / (0.5 * 1.2 * pi * 0.1**2 * speed**2), 8.0 if speed == 0.001 else 5.0)  # e-folds: decision 0045
        check(f"{speed} m/s: volume of the disc, off", abs(r.last("box.volume") / r.first("box.volume") - 1.0), 1e-3)
        clean(r)


def test_a_box_that_flies_keeps_its_gas():
    # 0.50 and 1.24 m2 of gas in the end before rows beside fluids left nothing of their pressure, of 0.15. Where gas does not fill
    # what opens its kinetic energy is off by 1.5e-2.
    for more, volume, kinetic in ((VOID_STAYS, 2e-3, 0.02), ({}, 1e-3, 1e-3)):
        for cells in 16, 32:
            r = harmos(ROOT / "test/verification/decks/gas_in_a_box.yaml", {
                "bodies/box/angle": 25.0, "bodies/gas/angle": 25.0, "bodies/box/velocity": "[50.0, 30.0]", "bodies/gas/velocity": "[50.0, 30.0]",
                "mesh/x/cells": cells, "mesh/y/cells": cells, "run/end_time": 4e-3, **more})
            what = f"{cells} cells{', void stays' if more else ''}"
            check(f"{what}: volume of the gas, off", abs(r.last("gas.volume") / r.first("gas.volume") - 1.0), volume)
            check(f"{what}: kinetic energy of the gas, off", max(abs(e / r.first("gas.kinetic_energy") - 1.0) for e in r["gas.kinetic_energy"]), kinetic)
            clean(r)


def test_stress_over_what_solids_fill_answers_a_uniform_pressure_with_uniform_tractions():
    exact = [(method, angle, 1e-6) for method in ("multipliers", "vital vertices", "mortar") for angle in (20.0, 33.0, 45.0)]
    everywhere = exact + [("multipliers", 35.0, 0.005), ("vital vertices", 35.0, 0.1)]
    full = exact + [("multipliers", 35.0, 0.05)]
    for where, cases in (("filled regions", everywhere), ("full cells", full)):
        for method, angle, bound in cases:
            METHODS["over regions"] = {**METHODS[method], "numerics/cut_cell_stress": where}
            check(f"{where}, {method}, {angle:.0f} degrees: deviation of the tractions", deviation("over regions", angle, refinement=2), bound)


def test_a_lone_rod_moves_the_same_in_full_cells():
    # Free surfaces and walls bound no full cell of several materials.
    history = []
    for where in ("fluids", "full cells"):
        r = harmos("taylor_rod/deck.yaml", {"numerics/cut_cell_stress": where, "run/end_time": 4e-5, "output/fields/every_time": 0.0})
        history.append(r.history)
        clean(r)
    assert history[0] == history[1]


def test_gas_at_rest_on_a_shaken_mesh_stays_at_rest():
    # Round-off alone: work done half a step late would drive it to half a per cent of the sound speed.
    settings = {"bodies": "{gas: {material: gas, shape: rectangle, center: [0.5, 0.5], size: [1.0, 1.0], density: 1.0, pressure: 1.0}}",
                "mesh": "{x: {from: 0.0, to: 1.0, cells: 8}, y: {from: 0.0, to: 1.0, cells: 8}, jitter: 0.2}",
                "run/end_time": 100.0, "output/fields/every_time": 0.0, "output/history/every_cycles": 50}
    laws = "{eos: ideal gas, gamma: 1.4, density: 1.0}", "{eos: stiffened, density: 1.0, sound_speed: 1.0, gruneisen: 2.0}"
    for law, geometry in ((laws[0], "planar"), (laws[1], "planar"), (laws[0], "axisymmetric")):
        r = harmos("shock_tube/deck.yaml", {"materials": "{gas: %s}" % law, "geometry": geometry, **settings})
        assert r.summary["cycles"] > 1500, r.summary["cycles"]
        check("kinetic energy", max(r["kinetic_energy"]), 1e-27)
        check("energy ledger", r.summary["energy_error"], 1e-12)
        clean(r)


def test_mortar_multipliers_keep_a_uniform_pressure_at_an_oblique_interface():
    for angle, bound in ((0.0, 1e-6), (20.0, 1e-6), (35.0, 0.05)):
        check(f"mortar, {angle:.0f} degrees: deviation of the tractions", deviation("mortar", angle), bound)


def test_iterations_of_small_blocks_stay_below_fifty_with_one_point_a_segment_and_sixty_with_two():
    # Dropped one by one, some thirty midpoints of the squeezed block took up to 54, twice as many Gauss points up to 148. Where sets
    # that throw the residual far once end their exchange, two points a segment take up to 57 in the unloaded one. By last digits of
    # the blocks Gauss points take 45, 46 or 55 at most in the squeezed one (28 in the mean), segment ends up to 51.
    runs = [(method, *BLOCKS[i], SQUEEZE) for method in ("multipliers", "two Gauss points", "segment ends") for i in (0, 1)]
    runs += [(method, *BLOCKS[2], pressure) for method in ("two Gauss points", "segment ends") for pressure in (0.0, SQUEEZE)]
    for method, angle, offset, pressure in runs:
        found = block(method, angle, offset, pressure)
        what = f"{method}, {angle} degrees, offset {offset}, {'squeezed' if pressure else 'unloaded'}"
        print(f"  {what}: mean {found['iterations']:.1f} iterations")
        check(f"{what}: most iterations", found["most iterations"], 50 if method == "multipliers" else 60)
        check(f"{what}: cycles that missed the tolerance", found["unconverged"], 0)


def test_iterations_stay_below_fifty_where_many_places_settle():
    # Over 200 cycles active sets and projected steps without the path inside the bounds take up to 108 and 84, and rows that rub
    # without giving way by a millionth up to 115.
    for cycles, columns in ((20, 100), (200, 1000)):
        for friction in (False, True):
            found = iterations_of_strip(columns, friction, "midpoint", cycles)
            what = f"{found['multipliers']:.0f} multipliers{', friction' if friction else ''}, {cycles} cycles"
            print(f"  {what}: mean {found['mean']:.1f} iterations")
            check(f"{what}: most iterations", found["most"], 50)
            check("cycles that missed the tolerance", found["missed"], 0)


if __name__ == "__main__":
    run(globals())
