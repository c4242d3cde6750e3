# SPDX-License-Identifier: BSD-3-Clause
"""A run that stops and goes on from a checkpoint leaves the tables of the run that did not stop."""
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time

import harness
from compare import ROUND_OFF, newest_checkpoint, same_history, same_state
from harness import Run, check, clean, harmos, run

HERE = pathlib.Path(__file__).resolve().parent
BALL, BLOCKS, HEAP = HERE / "rigid_ball.yaml", HERE / "two_blocks.yaml", HERE / "decks/heap.yaml"
DISC, BLOCK = "disc_through_plate/deck.yaml", "sliding_block/deck.yaml"
QUIET = {"output/fields/every_time": 0.0, "output/fields/at_end": "false"}
TABLES = ("history.csv", "contact.csv", "probes.csv", "tracers.csv")


def stop(settings, cycles):
    return {**QUIET, **settings, "run/max_cycles": cycles}


def same_tables(a, b):
    for name in TABLES:
        if (a / name).exists():
            left, right = (a / name).read_bytes(), (b / name).read_bytes()
            assert left == right, f"{name} differs"
            print(f"  {name}: {len(left)} bytes alike")


def goes_on(deck, settings=None, cycles=(33, 60), every=11, same_rows=True):
    """Stop at cycles[0] and go on to cycles[1] from the last checkpoint and from the one before.

    same_rows: the stopped run writes no row that the whole one lacks, so that the largest errors over rows agree too.
    """
    settings = settings or {}
    whole = harmos(deck, stop(settings, cycles[1]))
    part = harmos(deck, {**stop(settings, cycles[0]), "output/checkpoint/every_cycles": every})
    checkpoints = sorted(p.name for p in part.directory.glob("checkpoint_*.h5"))
    assert len(checkpoints) == 2, checkpoints
    for name in checkpoints:
        copy = pathlib.Path(str(part.directory) + "-copy")
        shutil.copytree(part.directory, copy)
        r = harmos(deck, stop(settings, cycles[1]), directory=copy, extra=["--restart", str(copy / name)])
        same_tables(whole.directory, copy)
        errors = ("mass_error", "momentum_error", "energy_error") if same_rows else ()
        for key in ("cycles", "pair_steps", "cell_steps", *errors):
            assert r.summary[key] == whole.summary[key], key
        clean(r)
    return whole, part


def test_xfem_with_tracers_and_probes():
    points = {"tracers/t": "{position: [-0.3, -0.1]}", "probes/p": "{position: [0.0, 0.0]}"}
    clean(*goes_on(BLOCK, points))


def test_single():
    clean(*goes_on(BLOCK, {"kinematics": "single"}))


def test_free_rigid_body():
    clean(*goes_on(BALL, cycles=(55, 80)))


def test_free_rings_about_an_axis_stay_on_their_radius():
    falls = "{material: hard, shape: disc, center: [0.3, 0.56], radius: 0.1, motion: free, velocity: [0.0, -3.0]}"
    cone = "{material: soft, shape: polygon, points: [0.0, 0.02, 0.6, 0.02, 0.6, 0.2, 0.0, 0.45]}"
    whole, part = goes_on(HERE / "decks/plunger.yaml", {"run/end_time": 1.0, "bodies": f"{{ring: {falls}, cone: {cone}}}"})
    check("impulse along the axis, of the ring's momentum", -abs(whole.last("ring.momentum_y") / whole.first("ring.momentum_y") - 1.0), -0.01)
    check("radius, change", abs(whole.last("ring.x_max") - whole.first("ring.x_max")), 0.0)
    clean(whole, part)


def test_gas_that_has_been_squeezed():
    # What counts as light goes by the densities of the start, not by those of the checkpoint.
    clean(*goes_on(HERE / "decks/impact_through_air.yaml", cycles=(150, 560), every=50, same_rows=False))


def test_solver_that_begins_with_the_last_forces():
    # Squeezed: without pressure the block touches nothing.
    warm = {"bodies/block/pressure": 6.75e8, "numerics/constraint/warm_start": "true", "numerics/constraint/tolerance": 1e-12,
            "interactions": "{default: friction, coefficient: 0.2}"}
    whole, part = goes_on(BLOCK, warm, cycles=(23, 30))
    cold = harmos(BLOCK, {**stop({**warm, "numerics/constraint/warm_start": "false"}, 30)})
    # Few sets from zero, or from near: about as many, and fewer where the sets settle slowly.
    assert sum(whole["iterations"]) <= 1.1 * sum(cold["iterations"])
    check("energy taken by contact, against a cold start", abs(whole.last("contact_loss") / cold.last("contact_loss") - 1.0), 1e-6)
    clean(whole, part, cold)


def test_conjugate_gradients_that_begin_with_the_last_forces():
    warm = {"bodies/block/pressure": 6.75e8, "numerics/constraint": "{solver: conjugate gradients, warm_start: true}"}
    clean(*goes_on(BLOCK, warm, cycles=(23, 30)))


def test_lagrangian():
    clean(*goes_on(BLOCKS))


def test_bonds_that_break_before_and_after_the_stop():
    whole, part = goes_on(HERE / "decks/peel.yaml", cycles=(60, 80))
    assert 0 < part.summary["broken_bonds"] < whole.summary["broken_bonds"]
    clean(whole, part)


def test_the_summary_has_the_warnings_from_before():
    few = {"numerics/constraint/max_iterations": 1, "numerics/remap/order": 1}
    part = harmos(BLOCKS, {**stop(few, 30), "output/checkpoint/at_end": "true"})
    before = part.summary["warnings"]
    assert any("multipliers stopped" in w for w in before) and any("without effect" in w for w in before), before
    r = harmos(BLOCKS, stop(few, 31), directory=part.directory, extra=["--restart", str(part.directory)])
    assert r.summary["warnings"] == before, r.summary["warnings"]
    clean(r)


def test_bonds_with_a_strength_are_not_made_by_a_restart():
    part = harmos(BLOCK, {**stop({}, 20), "output/checkpoint/at_end": "true"})
    good = ["--restart", str(newest_checkpoint(part.directory))]
    other = pathlib.Path(str(part.directory) + "-bonded")
    bonded = {**stop({}, 30), "interactions": "{default: bonded, tensile_strength: 1.0e15}"}
    r = harmos(BLOCK, bonded, directory=other, extra=good, expect=2)
    assert "interactions/" in r.text and len(r.text.splitlines()) == 1 and not other.exists(), r.text
    clean(part)


def test_a_folder_stands_for_its_newest_checkpoint():
    settings = {**QUIET, "output/checkpoint/every_cycles": 10}
    whole, part = (harmos(BALL, {**settings, "run/max_cycles": cycles}) for cycles in (40, 33))
    r = harmos(BALL, {**settings, "run/max_cycles": 40}, directory=part.directory, extra=["--restart", str(part.directory)])
    assert r.summary["cycles"] == 40
    same_tables(whole.directory, r.directory)
    clean(whole, r)


def test_disc_through_plate_with_a_row_every_seventh_cycle():
    # The row at cycle 33 was written because the run ended there: the run that goes on takes it back.
    # So it does not take from the next one the largest overlap of the cycles before.
    settings = {"output/history/every_cycles": 7, "output/history/polygon_overlap": "true"}
    clean(*goes_on(DISC, settings, same_rows=False))


def test_other_number_of_ranks():
    whole, part = goes_on(BALL, cycles=(33, 60))
    copy = pathlib.Path(str(part.directory) + "-ranks")
    shutil.copytree(part.directory, copy)
    settings = {**stop({}, 60), "output/checkpoint/at_end": "true"}
    r = harmos(BALL, settings, ranks=3, directory=copy, extra=["--restart", str(newest_checkpoint(copy))])
    worst, column = same_history(whole, r)
    check(f"history, worst in {column}", worst, ROUND_OFF)
    full = harmos(BALL, settings)
    same_state(newest_checkpoint(full.directory), newest_checkpoint(copy))
    clean(whole, part, r, full)


def start(deck, directory, settings, ranks=1, extra=()):
    command = [*harness.launcher(ranks), harness.HARMOS, "run", str(harness.EXAMPLE / deck), "--output", str(directory), *extra]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def rows(directory):
    history = directory / "history.csv"
    return len(history.read_text().splitlines()) if history.exists() else 0


def interrupt(with_signal):
    """Interrupt a run once it has some rows; then let it end: the same tables as without."""
    cycles = 150
    whole = harmos(DISC, stop({}, cycles))
    directory = pathlib.Path(str(whole.directory) + "-interrupted")
    process = start(DISC, directory, stop({}, cycles))
    while rows(directory) < 4 and process.poll() is None:
        time.sleep(0.01)
    process.send_signal(with_signal)
    text = process.communicate()[0]
    assert process.returncode == 4, f"exit status {process.returncode}\n{text}"
    first = Run(directory, 4, text)
    assert first.summary["status"] == "interrupted" and 0 < first.summary["cycles"] < cycles
    checkpoint = newest_checkpoint(directory)
    assert str(checkpoint) in text, text
    r = harmos(DISC, stop({}, cycles), directory=directory, extra=["--restart", str(checkpoint)])
    assert r.summary["status"] == "completed"
    same_tables(whole.directory, directory)
    clean(whole, r)


def test_light_nodes_are_counted_over_all_ranks():
    """The sums of a checkpoint are the same on all ranks: else its checksum is not that of what was written."""
    coarse = {"mesh/x/cells": 50, "mesh/y/cells": 120}
    part = harmos("whipple_high/deck.yaml", {**coarse, **stop({}, 300), "output/checkpoint/at_end": "true"}, ranks=2)
    extra = ["--restart", str(newest_checkpoint(part.directory))]
    clean(harmos("whipple_high/deck.yaml", {**coarse, **stop({}, 305)}, ranks=2, directory=part.directory, extra=extra))


def test_sigterm_writes_a_checkpoint_and_the_run_goes_on():
    interrupt(signal.SIGTERM)


def test_sigint_writes_a_checkpoint_and_the_run_goes_on():
    interrupt(signal.SIGINT)


def test_checkpoints_by_the_wall_clock():
    r = harmos(BALL, {**stop({}, 60), "output/checkpoint/every_wall_seconds": 1e-3})
    assert len(list(r.directory.glob("checkpoint_*.h5"))) == 2
    clean(r)


def contents(directory):
    return {p.name: p.read_bytes() for p in directory.iterdir()}


def test_bad_restart_files_change_nothing():
    part = harmos(BALL, {**stop({}, 20), "output/checkpoint/at_end": "true"})
    good = newest_checkpoint(part.directory)
    data = good.read_bytes()
    cut, damaged, text = (part.directory / name for name in ("cut.h5", "damaged.h5", "text.h5"))
    cut.write_bytes(data[: len(data) // 2])
    middle = len(data) // 2
    damaged.write_bytes(data[:middle] + bytes(b ^ 0x55 for b in data[middle : middle + 64]) + data[middle + 64 :])
    text.write_text("no HDF5 file\n")
    other = harmos(BLOCK, {**stop({}, 2), "output/checkpoint/at_end": "true"})
    cases = [cut, damaged, text, part.directory / "missing.h5", newest_checkpoint(other.directory)]
    before = contents(part.directory)
    for file in cases:
        r = harmos(BALL, stop({}, 40), directory=part.directory, extra=["--restart", str(file)], expect=2)
        assert len(r.text.splitlines()) == 1 and str(file) in r.text, r.text
        print(" ", r.text.strip())
        assert contents(part.directory) == before
    assert "missing.h5: there is no such file" in harmos(BALL, directory=part.directory, extra=["--restart", str(cases[3])], expect=2).text
    with tempfile.TemporaryDirectory() as empty:
        r = harmos(BALL, stop({}, 40), directory=part.directory, extra=["--restart", empty], expect=2)
        assert f"--restart {empty}: no checkpoint" in r.text and contents(part.directory) == before, r.text
    r = harmos(BALL, {**stop({}, 40), "mesh/x/cells": 41}, directory=part.directory, extra=["--restart", str(good)], expect=2)
    assert "mesh/x/cells" in r.text and contents(part.directory) == before, r.text
    clean(part, other)


def test_a_damaged_checkpoint_names_the_sound_one_before_it():
    part = harmos(BALL, {**stop({}, 20), "output/checkpoint/every_cycles": 10})
    older, newest = sorted(part.directory.glob("checkpoint_*.h5"))
    whole = newest.read_bytes()
    # A value, the deck and the names: a bit of each.
    for place in (len(whole) // 2, whole.index(b"aluminium"), whole.rindex(b"contact_force\n")):
        damaged = bytearray(whole)
        damaged[place] ^= 1
        newest.write_bytes(damaged)
        for given in (part.directory, newest):
            r = harmos(BALL, stop({}, 40), directory=part.directory, extra=["--restart", str(given)], expect=2)
            assert len(r.text.splitlines()) == 1 and "damaged" in r.text and f"; sound is the one before, {older}" in r.text, r.text
    print("  " + r.text.strip())
    # Nothing is wrong with the file where the deck differs.
    newest.write_bytes(whole)
    r = harmos(BALL, {**stop({}, 40), "mesh/x/cells": 41}, directory=part.directory, extra=["--restart", str(part.directory)], expect=2)
    assert "sound" not in r.text, r.text
    clean(part)


def test_mesh_and_bodies_stay_and_other_changes_are_named():
    part = harmos(BALL, {**stop({}, 20), "output/checkpoint/at_end": "true"})
    good = ["--restart", str(newest_checkpoint(part.directory))]
    other = pathlib.Path(str(part.directory) + "-changed")
    refused = {"mesh/y/to": 1.1, "bodies/plate/center": "[1.3, 0.5]"}
    for key, value in refused.items():
        r = harmos(BALL, {**stop({}, 40), key: value}, directory=other, extra=good, expect=2)
        assert key in r.text and len(r.text.splitlines()) == 1 and not other.exists(), r.text
    # The ball is rigid: its mass goes on from the checkpoint.
    r = harmos(BALL, {**stop({}, 40), "materials/hard/density": 7000.0}, directory=other, extra=good, expect=2)
    assert "materials/hard/density" in r.text and "keep their mass" in r.text and not other.exists(), r.text
    # A rigid law that no body has is no mass of any.
    r = harmos(BALL, {**stop({}, 40), "materials/aluminium/density": 2701.0, "materials/idle": "{eos: rigid, density: 1.0}"}, directory=other, extra=good)
    assert any("materials/aluminium/density" in text for text in r.summary["warnings"]), r.summary["warnings"]
    clean(part, r)


def test_warm_starts_of_rigid_bodies_go_on_as_they_were():
    # The keys of their rows take more digits than a double has.
    for stopped in (100, 150, 200):
        clean(*goes_on(HEAP, {"numerics/constraint/warm_start": "true", "output/history/every_cycles": 1}, cycles=(stopped, 240), every=stopped // 2))


def test_a_restart_with_nothing_left_to_do_touches_no_file():
    whole = harmos(BALL, {**stop({}, 30), "output/checkpoint/at_end": "true", "output/fields/at_end": "true"})
    before = contents(whole.directory)
    for cycles in (20, 30):
        r = harmos(BALL, stop({}, cycles), directory=whole.directory, extra=["--restart", str(newest_checkpoint(whole.directory))])
        assert "nothing is left to do" in r.text and contents(whole.directory) == before, r.text
    clean(whole)


def test_a_restart_that_is_killed_has_no_summary_of_the_run_before():
    part = harmos(BALL, {**stop({}, 20), "output/checkpoint/at_end": "true"})
    assert part.summary["status"] == "completed"
    settings = {**stop({}, 0), "run/end_time": 10.0}
    process = start(BALL, part.directory, settings, extra=["--restart", str(part.directory)])
    while rows(part.directory) < 25 and process.poll() is None:
        time.sleep(0.01)
    process.kill()
    process.communicate()
    assert process.returncode == -signal.SIGKILL and not (part.directory / "summary.json").exists()
    again = harmos(BALL, stop({}, 30), directory=part.directory, extra=["--restart", str(part.directory)])
    assert again.summary["status"] == "completed" and again.summary["cycles"] == 30
    clean(again)


def test_sigusr1_reaches_all_ranks_through_mpiexec():
    whole = harmos(DISC, stop({}, 150))
    directory = pathlib.Path(str(whole.directory) + "-ranks")
    process = start(DISC, directory, stop({}, 150), ranks=2)
    while rows(directory) < 4 and process.poll() is None:
        time.sleep(0.01)
    process.send_signal(signal.SIGUSR1)
    text = process.communicate()[0]
    first = Run(directory, process.returncode, text)
    assert first.summary["status"] == "interrupted" and 0 < first.summary["cycles"] < 150, text
    r = harmos(DISC, stop({}, 150), directory=directory, ranks=2, extra=["--restart", str(newest_checkpoint(directory))])
    worst, column = same_history(whole, r)
    check(f"history, worst in {column}", worst, ROUND_OFF)
    clean(whole, r)


if __name__ == "__main__":
    run(globals())
