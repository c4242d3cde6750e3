# SPDX-License-Identifier: BSD-3-Clause
"""Reconstruction without mechanics: shapes that a prescribed velocity field carries, against their exact outlines.

Bounds are measured values with a margin; the figures in brackets are those of the literature or of peers.
"""
from math import pi

from harness import check, clean, harmos, run

METHODS = ["moment of fluid", "least squares", "youngs"]


def carried(deck, settings, ranks=1):
    r = harmos(deck, dict({"output/fields/every_time": 0.0, "output/fields/at_end": False}, **settings), ranks=ranks)
    errors = r.summary["shape_errors"]
    check("mass", r.summary["mass_error"], 1e-12)
    check("momentum ledger", r.summary["momentum_error"], 1e-11)
    check("energy ledger", r.summary["energy_error"], 1e-11)
    for name in [key[:-5] for key in errors if key.endswith(".area")]:
        check(f"{name} volume", abs(errors[name + ".volume_error"]) / errors[name + ".area"], 1e-12)
        assert errors[name + ".symmetric_difference"] >= errors[name + ".l1"] * (1 - 1e-12)
    clean(r)
    return errors


def cells(n):
    return {"mesh/x/cells": n, "mesh/y/cells": n}


def by_method(deck, settings, bounds, name="disc"):
    for method, bound in zip(METHODS, bounds):
        errors = carried(deck, dict({"numerics/reconstruction/method": method}, **settings))
        check(f"{method}: symmetric difference of the area", errors[name + ".symmetric_difference"] / errors[name + ".area"], bound)


def test_circle_at_rest_is_reconstructed_to_second_order():
    # [LVIRA 9.8e-4, 2.52e-4, 6.3e-5; moment of fluid 5.8e-4, 1.82e-4, 4.3e-5]
    still = {"prescribed_velocity": "{field: translation, velocity: [0.0, 0.0]}", "bodies/disc/center": "[0.5, 0.5]", "bodies/disc/radius": 0.3, "run/end_time": 1.0}
    for n, bounds in [(32, [5.8e-4, 9.8e-4, 1.1e-3]), (64, [1.82e-4, 2.52e-4, 5.0e-4]), (128, [4.3e-5, 6.3e-5, 2.2e-4])]:
        by_method("vortex/deck.yaml", {**cells(n), **still}, bounds)


def test_straight_line_is_exact_on_random_quadrilaterals():
    line = "{material: fluid, shape: half-plane, point: [0.47, 0.53], normal: [%s, %s]}"
    still = {"prescribed_velocity": "{field: translation, velocity: [0.0, 0.0]}", "run/end_time": 1.0, "mesh/jitter": 0.24, **cells(32)}
    for seed, (a, b) in enumerate([(1.0, 0.3), (-0.2, 1.0), (-1.0, -1.0), (0.7, -1.0)]):
        by_method("vortex/deck.yaml", {**still, "mesh/jitter_seed": seed, "bodies": "{disc: %s}" % (line % (a, b))}, [1e-12, 1e-12, 1e-2])


def test_circle_at_rest_on_random_quadrilaterals():
    still = {"prescribed_velocity": "{field: translation, velocity: [0.0, 0.0]}", "bodies/disc/center": "[0.5, 0.5]", "bodies/disc/radius": 0.3, "run/end_time": 1.0, "mesh/jitter": 0.2}
    for n, bounds in [(32, [7e-4, 1.2e-3, 3e-3]), (64, [2.2e-4, 3e-4, 2e-3]), (128, [5.2e-5, 7.5e-5, 1e-3])]:
        by_method("vortex/deck.yaml", {**cells(n), **still}, bounds)


def test_disc_comes_back_from_the_vortex_on_random_quadrilaterals():
    by_method("vortex/deck.yaml", {**cells(64), "prescribed_velocity/period": 2.0, "run/end_time": 2.0, "mesh/jitter": 0.2}, [2.8e-3, 1.2e-2, 1.5e-2])


def test_disc_comes_back_from_the_vortex():
    by_method("vortex/deck.yaml", {**cells(64), "prescribed_velocity/period": 2.0, "run/end_time": 2.0}, [2.4e-3, 1.0e-2, 1.3e-2])


def test_disc_comes_back_from_the_long_vortex():
    # [at 64: 1.05e-2 of 0.0707, ELVIRA]
    errors = carried("vortex/deck.yaml", {"numerics/reconstruction/method": "least squares"})
    check("least squares: symmetric difference", errors["disc.symmetric_difference"], 1.0e-2)


def test_merging_fragments_loses_nothing_and_changes_little():
    error = {}
    for merge in (0.0, 1e-6):
        settings = {"numerics/remap/merge_below": merge, "output/fields/every_time": 0.0, "output/fields/at_end": False}
        r = harmos("vortex/deck.yaml", settings)
        errors = r.summary["shape_errors"]
        error[merge] = errors["disc.symmetric_difference"]
        check(f"merging below {merge}: symmetric difference", error[merge], 1.0e-2)
        check("volume", abs(errors["disc.volume_error"]) / errors["disc.area"], 1e-12)
        check("mass", r.summary["mass_error"], 1e-12)
        assert r.summary["unfinished_interfaces"] == 0
        assert (r.summary["merged_fragments"] > 0) == (merge > 0.0), r.summary["merged_fragments"]
        clean(r)
    check("difference", abs(error[1e-6] - error[0.0]), 1e-6)


def test_three_materials_come_back_from_the_vortex():
    deck = "vortex/three_materials.yaml"
    errors = carried(deck, {})
    for name in ["first", "second", "third"]:
        check(f"{name}: symmetric difference of the area", errors[name + ".symmetric_difference"] / errors[name + ".area"], 1.5e-2)


def test_disc_comes_back_from_the_deformation():
    errors = carried("deformation/deck.yaml", {})
    check("symmetric difference of the area", errors["disc.symmetric_difference"] / errors["disc.area"], 0.1)


def test_slotted_disc_turns():
    # [Youngs 1.09e-2, Puckett 1.00e-2 in L1 after one turn at 200]
    by_method("zalesak/deck.yaml", {**cells(100), "run/end_time": 0.25}, [1.0e-2, 2.5e-2, 2.5e-2])


def test_square_is_carried_by_a_translation():
    square = {"prescribed_velocity": "{field: translation, velocity: [1.0, 0.6]}", "bodies/disc": "{material: fluid, shape: rectangle, center: [0.2, 0.2], size: [0.2, 0.2]}", "run/end_time": 0.5}
    # Through half a cell and more each step, sides along the mesh: exact but for the corners.
    by_method("vortex/deck.yaml", {**cells(64), **square}, [2.5e-2, 6e-2, 6e-2])


def test_field_that_carries_material_through_a_side_is_refused():
    move = {"prescribed_velocity": "{field: translation, velocity: [1.0, 0.0]}", "run/end_time": 0.5, **cells(16)}
    line = "{disc: {material: fluid, shape: half-plane, point: [0.47, 0.53], normal: [1.0, 0.3]}}"
    for ranks in (1, 2):
        r = harmos("vortex/deck.yaml", {**move, "bodies": line}, ranks=ranks, expect=2)
        assert "prescribed_velocity: it carries body disc through a side of the mesh" in r.text, r.text
    # The same half-plane may move along the sides that it meets.
    along = {"prescribed_velocity": "{field: translation, velocity: [0.0, 0.0]}", "run/end_time": 0.5, **cells(16)}
    clean(harmos("vortex/deck.yaml", {**along, "bodies": line}))
    # A disc that comes to a side later: the run stops there.
    for ranks in (1, 2):
        r = harmos("vortex/deck.yaml", {**move, "bodies/disc/center": "[0.6, 0.5]"}, ranks=ranks, expect=3)
        assert "the prescribed field carries material through a side of the mesh: cell" in r.text, r.text
        assert 0.18 < r.summary["end_time"] < 0.26, r.summary["end_time"]
        clean(r)


def test_state_does_not_depend_on_the_ranks():
    setting = {**cells(48), "prescribed_velocity/period": 2.0, "run/end_time": 2.0}
    one = carried("vortex/deck.yaml", setting)
    two = carried("vortex/deck.yaml", setting, ranks=2)
    # Sums over cells agree to round-off; the state behind them to the bit.
    for key in one:
        check(key, abs(one[key] - two[key]), 1e-15)


def test_restart_goes_on_to_the_same_end():
    setting = {**cells(32), "prescribed_velocity/period": 2.0, "run/end_time": 2.0, "output/checkpoint/every_cycles": 40}
    whole = harmos("vortex/deck.yaml", setting)
    checkpoint = whole.directory / "checkpoint_000000040.h5"
    rest = harmos("vortex/deck.yaml", setting, extra=["--restart", str(checkpoint)])
    assert rest.summary["shape_errors"] == whole.summary["shape_errors"], (rest.summary["shape_errors"], whole.summary["shape_errors"])
    clean(whole, rest)


def test_full_turn_and_half_turn_are_both_known():
    turn = {"prescribed_velocity": "{field: rotation, center: [0.5, 0.5], angular_velocity: 1.0}", "run/end_time": pi / 3}
    by_method("vortex/deck.yaml", {**cells(64), **turn}, [2e-3, 8e-3, 1e-2])


if __name__ == "__main__":
    run(globals())
