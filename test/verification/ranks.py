# SPDX-License-Identifier: BSD-3-Clause
"""One, two and four ranks give the same answer: the state bit for bit, the sums of the history to round-off."""
import pathlib

from compare import newest_checkpoint, same_on_ranks, same_state
from contact_scenes import tee_settings
from harness import clean, harmos, run
from sliding_block import SQUEEZE, settings

HERE = pathlib.Path(__file__).resolve().parent
CYCLES = 100
COMMON = {
    "run/max_cycles": CYCLES,
    "output/history/every_cycles": 1,
    "output/fields/every_time": 0.0,
    "output/fields/at_end": "false",
    "output/checkpoint/at_end": "true",
}


def compare(deck, more=None, ranks=(2, 4)):
    setting = {**(more or {}), **COMMON}
    one = harmos(deck, setting)
    assert one.last("cycle") == CYCLES
    same_on_ranks(one, deck, setting, ranks)
    return one


def test_translation_patch():
    clean(compare("translation_patch/deck.yaml"))


def test_pure_cells():
    for order in 2, 3:
        small = {"mesh/x/cells": 64, "mesh/y/cells": 64, "numerics/remap/order": order}
        clean(compare("pure_speed/deck.yaml", small))


def test_third_order_with_swept_faces():
    for deck in "translation_patch/deck.yaml", "taylor_rod_axisymmetric/deck.yaml":
        clean(compare(deck, {"numerics/remap/order": 3}))


def test_two_bars():
    clean(compare("two_bars/deck.yaml"))


def test_squeezed_sliding_block():
    clean(compare("sliding_block/deck.yaml", settings(15.0, (0.31, 0.17), 8, SQUEEZE)))


def test_squeezed_blocks_whose_short_segments_lie_across_ranks():
    h = 2.4 / 38
    clean(compare(HERE / "decks/tee.yaml", tee_settings(30.0, (0.31 * h, 0.17 * h), 1.0)))


def test_breaking_bonds():
    r = compare(HERE / "decks/peel.yaml")
    assert r.summary["broken_bonds"] > 0
    clean(r)


def test_block_rubbing_on_an_incline():
    clean(compare("incline/deck.yaml"))


def test_steps_that_parts_of_cut_cells_shorten():
    clean(compare(HERE / "decks/disc_in_a_ring.yaml"))


def test_a_box_of_gas_that_flies():
    clean(compare(HERE / "decks/gas_in_a_box.yaml", {
        "bodies/box/angle": 25.0, "bodies/gas/angle": 25.0, "bodies/box/velocity": "[50.0, 30.0]", "bodies/gas/velocity": "[50.0, 30.0]",
        "mesh/x/cells": 32, "mesh/y/cells": 32, "run/end_time": 1.0}))


def test_single_velocity_block():
    clean(compare("sliding_block/deck.yaml", settings(15.0, (0.31, 0.17), 8, kinematics="single"), ranks=(4,)))


def test_disc_through_plate():
    r = compare("disc_through_plate/deck.yaml", {"output/history/polygon_overlap": "true"}, ranks=(2, 3, 4))
    assert r.last("polygon_overlap") > r.last("overlap_volume") > 0.0
    clean(r)


def test_failure_on_one_rank_alone():
    # The rear wall, still whole, lies on another rank than the bumper.
    clean(compare("whipple_high/deck.yaml", ranks=(2,)))


def test_free_rigid_ball_in_contact_begun_with_the_last_forces():
    for solver in ("projected newton", "conjugate gradients"):
        clean(compare(HERE / "rigid_ball.yaml", {"numerics/constraint": f"{{solver: {solver}, warm_start: true}}"}, ranks=(2, 4)))


def test_free_rigid_ball_in_contact():
    r = compare(HERE / "rigid_ball.yaml", ranks=(2, 4))
    assert max(r["multipliers"]) > 0, "the ball must touch the plate"
    clean(r)


def test_cells_twice_as_long_as_wide_with_tracers_and_probes():
    points = {"tracers/t": "{position: [0.66, 0.7]}", "probes/p": "{position: [1.0, 0.5]}", "mesh/y/cells": 40}
    runs = [harmos(HERE / "rigid_ball.yaml", {**points, **COMMON}, ranks=n) for n in (1, 4)]
    same_state(*(newest_checkpoint(r.directory) for r in runs))
    for name in ("tracers.csv", "probes.csv"):
        texts = [(r.directory / name).read_text() for r in runs]
        assert texts[0] == texts[1], name
        assert len(texts[0].splitlines()) == CYCLES + 2
    clean(*runs)


def test_lagrangian_and_narrow_cells_are_refused_on_several_ranks():
    for deck, more, words in (
        ("two_blocks.yaml", {}, "lagrangian runs on one rank only"),
        ("rigid_ball.yaml", {"mesh/y/cells": 101}, "cells of aspect ratio up to 5.05"),
        ("rigid_ball.yaml", {"mesh/y/cells": 78, "mesh/jitter": 0.2}, "mesh: cells of aspect ratio up to"),
    ):
        r = harmos(HERE / deck, {**more, **COMMON}, ranks=2, expect=2)
        lines = [line for line in r.text.splitlines() if line.startswith("harmos:")]
        assert len(lines) == 1 and words in lines[0], r.text
        assert not r.history
        clean(r)
    clean(harmos(HERE / "rigid_ball.yaml", {**COMMON, "mesh/y/cells": 80, "run/max_cycles": 1}, ranks=2))  # just 4 : 1


if __name__ == "__main__":
    run(globals())
