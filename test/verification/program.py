# SPDX-License-Identifier: BSD-3-Clause
"""What the program answers: messages, exit status, what it writes and what it leaves alone."""
import json
import math
import pathlib
import re
import resource
import subprocess
import tempfile
import time

import harness
from compare import newest_checkpoint
from harness import check, clean, harmos, run

HERE = pathlib.Path(__file__).resolve().parent
BALL, BLOCKS = HERE / "rigid_ball.yaml", HERE / "two_blocks.yaml"
ROLLING = HERE / "decks/rolling.yaml"
SHORT = {"run/max_cycles": 3}


def program(*arguments, ranks=1, cwd=None):
    command = [harness.HARMOS] + [str(a) for a in arguments]
    if ranks > 1:
        command = ["mpiexec", "--oversubscribe", "--allow-run-as-root", "-n", str(ranks)] + command
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=cwd)


def refused(words, *sets, deck=BALL, ranks=1):
    """`run` must say one line with these words on stderr, exit 2 and make nothing."""
    with tempfile.TemporaryDirectory() as scratch:
        out = pathlib.Path(scratch) / "results"
        settings = [part for s in sets for part in ("--set", s)]
        r = program("run", deck, "--output", out, *settings, ranks=ranks)
        lines = [line for line in r.stderr.splitlines() if ranks == 1 or line.startswith("harmos:")]
        assert r.returncode == 2, f"{sets}: exit status {r.returncode}\n{r.stderr}"
        assert len(lines) == 1, r.stderr
        for word in words:
            assert word in lines[0], f"'{word}' is not in: {lines[0]}"
        assert not out.exists(), f"{sets}: {out} was made"
        print("  " + lines[0].replace(str(HERE), "..."))


def test_bad_decks_are_one_line_with_the_path_of_the_key():
    refused(["run/end_tme", "unknown key", "end_time"], "run/end_tme=1.0")
    refused(["run/max_cycles", "integer"], "run/max_cycles=three")
    refused(["bodies/ball/radius", "out of range"], "bodies/ball/radius=-0.2")
    refused(["bodies/plate/motion"], "bodies/plate/motion=free")
    refused(["kinematics"], "kinematics=eulerian")
    refused(["bodies/ball/motion", "single"], "kinematics=single")
    refused(["output/vtu"], "output/vtu=true", "output/xdmf=false")
    refused(["bodies/ball", "material"], "bodies/ball/material=gold")
    refused(["probes/far/position", "outside of the mesh"], "probes/far={position: [5.0, 0.0]}")
    refused(["tracers/lost/position", "void"], "tracers/lost={position: [0.1, 0.1]}")
    refused(["missing.yaml", "cannot be read"], deck=HERE / "missing.yaml")
    refused(["decks", "cannot be read"], deck=HERE / "decks")
    refused(["probes/p: [0.1, 0.1] is no map; expected: a map with the keys position"], "probes/p=[0.1, 0.1]")


def test_bodies_too_small_for_their_place_or_their_cell_are_refused():
    refused(["bodies/plate/size: [1e-17, 1e-17] is lost in the digits of the place"], "bodies/plate/size=[1e-17, 1e-17]")
    refused(["bodies/plate: it fills ", " of a cell; expected: a body that fills 1e-14 of one at least"], "bodies/plate/size=[1e-9, 1e-9]")


def test_overlapping_bodies_are_one_line_on_any_number_of_ranks():
    overlap = "bodies/ball/center=[0.9, 0.5]"
    refused(["cell", "plate", "ball", "overlap"], overlap)
    refused(["cell", "plate", "ball", "overlap"], overlap, ranks=3)
    refused(["run/end_tme"], "run/end_tme=1.0", ranks=3)


def test_lines_of_the_set_up_begin_with_the_name_of_the_deck():
    for words, *sets in ((["bodies: cell ", "overlap"], "bodies/ball/center=[0.9, 0.5]"), (["run/max_dt"], "run/max_dt=1e-16"),
                         (["tracers/lost"], "tracers/lost={position: [0.1, 0.1]}")):
        refused([f"harmos: {BALL}: {words[0]}", *words[1:]], *sets)
    part = "bodies/upper={material: aluminium, shape: mesh part, part: p}"
    refused([f"harmos: {BLOCKS}: mesh/file: ", "none.msh: cannot be read"], "kinematics=lagrangian", "mesh/file=none.msh", part, deck=BLOCKS)


def test_empty_values_of_options_are_refused():
    for option in ("--output", "--restart", "--set"):
        r = program("run", BALL, option, "")
        assert r.returncode == 2 and f"harmos: {option} needs a value" in r.stderr and len(r.stderr.splitlines()) == 1, r.stderr


def test_unknown_options_and_commands():
    for arguments in (("run", BALL, "--outptu", "x"), ("run",), ("run", BALL, BALL), ("fly", BALL), (), ("run", BALL, "--set")):
        r = program(*arguments)
        assert r.returncode == 2 and r.stderr and not r.stdout, arguments


def test_version_help_schema_and_check():
    version = program("--version")
    assert version.returncode == 0
    for name in ("harmos", "kokkos", "tpetra", "hdf5", "mpi"):
        assert re.search(rf"^{name} \S", version.stdout, re.M), name
    assert "usage:" in program("--help").stdout
    schema = program("schema")
    assert schema.returncode == 0
    for key in ("run/end_time", "bodies/NAME/shape", "numerics/remap/order", "output/checkpoint/every_wall_seconds"):
        assert re.search(rf"^{key}\b", schema.stdout, re.M), key
    assert schema.stdout.count("type: ") == schema.stdout.count("default: ") > 60
    with tempfile.TemporaryDirectory() as scratch:
        good = program("check", BALL, cwd=scratch)
        assert good.returncode == 0 and "good" in good.stdout
        assert program("check", BALL, "--set", "run/end_tme=1", cwd=scratch).returncode == 2
        overlap = program("check", BALL, "--set", "bodies/ball/center=[0.9, 0.5]", cwd=scratch)
        assert overlap.returncode == 2 and "(plate) and body" in overlap.stderr and "overlap at (" in overlap.stderr, overlap.stderr
        assert not list(pathlib.Path(scratch).iterdir())


def test_results_are_not_overwritten_without_force():
    r = harmos(BALL, SHORT)
    before = {p.name: p.read_bytes() for p in r.directory.iterdir()}
    again = program("run", BALL, "--output", r.directory, "--set", "run/max_cycles=4")
    assert again.returncode == 2 and "--force" in again.stderr and len(again.stderr.splitlines()) == 1
    assert {p.name: p.read_bytes() for p in r.directory.iterdir()} == before
    forced = program("run", BALL, "--output", r.directory, "--force", "--set", "run/max_cycles=4")
    assert forced.returncode == 0, forced.stderr
    assert json.loads((r.directory / "summary.json").read_text())["cycles"] == 4
    clean(r)


def test_restart_into_a_folder_of_other_results_needs_force():
    a = harmos(BALL, {**SHORT, "output/checkpoint/at_end": "true"})
    b = harmos(BALL, SHORT)
    before = (b.directory / "history.csv").read_bytes()
    restart = ("--restart", newest_checkpoint(a.directory), "--set", "run/max_cycles=5")
    r = program("run", BALL, "--output", b.directory, *restart)
    assert r.returncode == 2 and "--force" in r.stderr, r.stderr
    assert (b.directory / "history.csv").read_bytes() == before
    assert program("run", BALL, "--output", b.directory, "--force", *restart).returncode == 0
    rows = (b.directory / "history.csv").read_text().splitlines()
    assert [row.split(",")[0] for row in rows] == ["cycle", "4", "5"]
    clean(a, b)


def begin(*arguments, **settings):
    """A run that has begun to write into `settings['into']`, without an end."""
    into = settings["into"]
    command = [harness.HARMOS, "run", str(BALL), "--output", str(into), "--set", "run/end_time=10.0", *map(str, arguments)]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, restore_signals=False)  # SIGXFSZ stays ignored
    deadline = time.time() + 60
    while not (into / "history.csv").exists() or len((into / "history.csv").read_text().splitlines()) < 4:
        assert process.poll() is None and time.time() < deadline, "the run does not begin"
        time.sleep(0.01)
    return process


def test_a_folder_takes_one_run_at_a_time():
    with tempfile.TemporaryDirectory() as scratch:
        out = pathlib.Path(scratch) / "w"
        out.mkdir()
        first = begin("--set", "output/checkpoint/every_cycles=2", into=out)
        try:
            for ranks, words in ((1, ["--force"]), (2, ["--force"]), (1, ["--restart", out]), (1, [])):
                second = program("run", BALL, "--output", out, *words, ranks=ranks)
                lines = [line for line in second.stderr.splitlines() if line.startswith("harmos:")]
                assert second.returncode == 2 and len(lines) == 1 and f"is in use by another run (process {first.pid} on " in lines[0], second.stderr
            assert first.poll() is None
            before = (out / "history.csv").read_text().splitlines()
            assert [line.split(",")[0] for line in before[1:-1]] == [str(i) for i in range(len(before) - 2)]
        finally:
            first.kill()
            first.wait()
        print("  " + lines[0].replace(scratch, "..."))
        # What a killed run leaves locks nothing.
        assert (out / ".lock").exists()
        assert program("run", BALL, "--output", out, "--force", "--set", "run/max_cycles=2").returncode == 0
        assert not (out / ".lock").exists()


def test_folders_named_as_results_are_refused_before_anything_is_touched():
    r = harmos(BALL, {**SHORT, "output/fields/at_end": "true"})
    (r.directory / "fields_000007.h5/inside").mkdir(parents=True)
    before = {p.name: p.is_dir() or p.read_bytes() for p in r.directory.iterdir()}
    again = program("run", BALL, "--output", r.directory, "--force")
    assert again.returncode == 2 and "fields_000007.h5' is a folder" in again.stderr and len(again.stderr.splitlines()) == 1, again.stderr
    assert {p.name: p.is_dir() or p.read_bytes() for p in r.directory.iterdir()} == before
    clean(r)


def test_a_run_that_cannot_write_leaves_a_summary():
    with tempfile.TemporaryDirectory() as scratch:
        # Files that cannot grow, as on a full disk.
        out = pathlib.Path(scratch) / "w"
        process = begin(into=out)
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (16384, 16384))
        assert process.wait(timeout=60) == 3 and (out / "history.csv").stat().st_size <= 16384
        summary = json.loads((out / "summary.json").read_text())
        assert summary["status"] == "failed" and summary["cycles"] > 3 and not (out / ".lock").exists()
        assert any(w.startswith("failed: cannot append to ") and "history.csv" in w for w in summary["warnings"]), summary["warnings"]
        for ranks in (1, 2):
            out = pathlib.Path(scratch) / f"in-the-way-{ranks}"
            (out / "fields_000001.h5.tmp").mkdir(parents=True)
            r = program("run", BALL, "--output", out, "--set", "output/fields/every_cycles=2", ranks=ranks)
            summary = json.loads((out / "summary.json").read_text())
            assert r.returncode == 3 and (summary["status"], summary["cycles"], summary["ranks"]) == ("failed", 2, ranks), (r.stderr, summary)
            assert any(w.startswith("failed: ") and "fields_000001.h5.tmp" in w for w in summary["warnings"]), summary["warnings"]


def test_an_inverted_cell_stops_the_run_and_keeps_the_last_checkpoint():
    fast = {"bodies/upper/velocity": "[0.0, -6000.0]", "bodies/lower/velocity": "[0.0, 6000.0]", "output/checkpoint/every_cycles": 5}
    r = harmos(BLOCKS, fast, expect=3)
    line = [text for text in r.text.splitlines() if text.startswith("harmos:")]
    assert len(line) == 1, r.text
    assert re.search(r"cycle \d+: a moved cell is inverted: cell \d+ on rank 0, material (lower|upper)", line[0]), line
    last = newest_checkpoint(r.directory)
    assert str(last) in line[0], line
    assert r.summary["status"] == "failed" and any("inverted" in w for w in r.summary["warnings"])
    # It is good: the run goes on from it, to the same end.
    again = harmos(BLOCKS, fast, directory=r.directory, extra=["--restart", str(last)], expect=3)
    assert again.summary["cycles"] == r.summary["cycles"]
    print("  " + line[0])
    clean(r)


def test_long_cells_between_bodies_are_a_warning():
    for cells, warned in ((60, False), (8, True)):
        r = harmos("two_discs/deck.yaml", {"mesh/x/cells": 60, "mesh/y/cells": cells, "run/max_cycles": 1})
        words = [w for w in r.summary["warnings"] if "times as long as wide" in w]
        assert len(words) == (1 if warned else 0), r.summary["warnings"]
        assert not warned or "6 times" in words[0] and words[0] in r.text, words
        clean(r)


def test_keys_without_use_for_the_kinematics_are_a_warning():
    """One deck serves the three kinematics: such keys are no error, and not passed over in silence."""
    for given, named in (({}, None), ({"numerics/remap/order": 1}, "numerics/remap/order: without effect in this run (these kinematics and bodies)")):
        r = harmos(BLOCKS, {**SHORT, **given})
        assert r.summary["warnings"] == ([named] if named else []), r.summary["warnings"]
        assert not named or named in r.text, r.text
        clean(r)


def test_keys_of_contact_without_use_are_a_warning():
    def named(deck, **keys):
        r = harmos(deck, {**SHORT, **{path.replace("__", "/"): value for path, value in keys.items()}})
        paths = [w.split(":")[0] for w in r.summary["warnings"] if "without effect" in w]
        clean(r)
        return paths

    alone = HERE / "decks/tension.yaml"
    assert named(alone, numerics__constraint="{tolerance: 1.0e-6}", interactions="{default: bonded}") == ["interactions/default, numerics/constraint/tolerance"]
    assert named(alone, numerics__constraint="{tolerance: 1.0e-6}", boundaries__left="{type: contact wall}") == []


def test_what_body_fitted_blocks_cannot_do_is_refused():
    refused(["bodies/upper/join", "weld"], "bodies/upper/join=lower", deck=BLOCKS)
    refused(["numerics/constraint/placement", "gauss points"], "numerics/constraint/placement=gauss points", deck=BLOCKS)


def test_blocks_that_lie_in_each_other_are_refused():
    refused(["bodies: block 1 overlaps block 0"], "bodies/upper/center=[0.52, 0.6]", deck=BLOCKS)
    # Bent sides, which the blocks' corners say nothing of.
    refused(["bodies/upper", "overlaps lower at"], "bodies/upper/center=[0.52, 0.78]", "bodies/upper/arc_radii=[0.31, 0.0, 0.0, 0.0]", deck=BLOCKS)


def test_rigid_bodies_keep_their_outline():
    refused(["bodies/plug/cut", "the rigid body disc cannot be cut"], "bodies/plug={material: hard, shape: disc, center: [-0.4, 0.211], radius: 0.1, motion: free, cut: true}",
            "interactions={default: sliding}", deck=ROLLING)


def test_free_rigid_bodies_that_pass_a_wall_are_a_warning():
    """Slip walls hold nodes of the mesh, which rigid bodies have none of; a contact wall holds them."""
    for wall, passed in (("slip wall", True), ("contact wall", False)):
        r = harmos(ROLLING, {"boundaries/right": f"{{type: {wall}}}", "bodies/disc/center": "[0.79, 0.311]", "bodies/disc/velocity": "[2.0, 0.0]", "run/end_time": 0.1})
        words = [w for w in r.summary["warnings"] if "goes through the slip wall right" in w]
        assert len(words) == (1 if passed else 0), r.summary["warnings"]
        clean(r)


def test_a_healthy_time_step_is_good_at_any_end_time():
    r = harmos(BALL, {"run/end_time": 1e6, **SHORT})
    assert r.summary["cycles"] == 3 and not r.summary["warnings"], r.summary
    clean(r)


SQUEEZE = """harmos:
  kinematics: lagrangian
  mesh: {x: {from: 0.0, to: 1.0, cells: 1}, y: {from: 0.0, to: 1.0, cells: 1}}
  boundaries: {left: {type: prescribed, normal_velocity: -100.0}}
  materials: {soft: {eos: stiffened, density: 1000.0, sound_speed: 10.0}}
  bodies: {block: {material: soft, shape: rectangle, center: [0.5, 0.5], size: [1.0, 1.0]}}
  numerics: {courant: 0.9, linear_viscosity: 0.0, quadratic_viscosity: 0.0}
  run: {end_time: 1.0, initial_dt: 1.0e-3, max_cycles: 20}
  output: {checkpoint: {at_end: true}}
"""


def test_a_time_step_that_shrinks_without_bound_names_its_pair_also_after_a_restart():
    """A piston closes on a wall at 100 m/s: the one cell between them, and so the step, goes to nothing at 10 ms."""
    with tempfile.TemporaryDirectory() as scratch:
        deck = pathlib.Path(scratch) / "squeeze.yaml"
        deck.write_text(SQUEEZE)
        half = harmos(deck)
        whole = harmos(deck, {"run/max_cycles": 0}, expect=3)
        again = harmos(deck, {"run/max_cycles": 0}, extra=["--restart", str(newest_checkpoint(half.directory))], expect=3)
        pattern = r"cycle (\d+): the time step (\S+) s is too small, beside 9.000e-02 s at the start: set by cell 0 on rank 0, material block"
        found = [re.search(pattern, r.text) for r in (whole, again)]
        assert all(found), (whole.text, again.text)
        assert found[0].groups() == found[1].groups() and float(found[0].group(2)) < 9e-12
        check("time left to the end", abs(whole.last("time") / 0.01 - 1.0), 1e-6)
        print("  " + found[0].group(0))
        clean(half, whole, again)


def test_steps_and_speeds_that_cannot_work_are_refused():
    refused(["run/initial_dt: 1e-16", "1e-10 of the stable step"], "run/initial_dt=1e-16")
    refused(["run/max_dt: 1e-16", "1e-10 of the stable step"], "run/max_dt=1e-16")
    for ranks in (1, 3):
        refused(["bodies/ball: a speed of 1e+200 m/s", "light"], "bodies/ball/velocity=[1e200, 0.0]", ranks=ranks)
    refused(["bodies/plate: a speed of", "light"], "bodies/plate/radial_velocity=100.0", "bodies/plate/radial_exponent=-10.0", "bodies/plate/radial_radius=0.3")


PIE = """harmos:
  mesh: {{x: {{from: -1.0, to: 1.0, cells: 5}}, y: {{from: -1.0, to: 1.0, cells: 5}}}}
  materials: {{m: {{eos: stiffened, density: 1000.0, sound_speed: 1000.0}}}}
  run: {{end_time: 1.0e-3, max_cycles: 2}}
  bodies:
{bodies}"""


def test_more_materials_than_a_cell_can_hold_are_counted():
    with tempfile.TemporaryDirectory() as scratch:
        deck = pathlib.Path(scratch) / "pie.yaml"
        point = lambda i, n: f"{0.9 * math.cos(2 * math.pi * i / n):.15f}, {0.9 * math.sin(2 * math.pi * i / n):.15f}"
        for sectors in (12, 16):
            bodies = [f"    s{i}: {{material: m, shape: polygon, points: [0.0, 0.0, {point(i, sectors)}, {point(i + 1, sectors)}]}}\n"
                      for i in range(sectors)]
            deck.write_text(PIE.format(bodies="".join(bodies)))
            if sectors == 16:
                refused(["cell 12", "16 materials meet in it, and at most 12 can"], deck=deck)
            else:
                assert program("check", deck).returncode == 0


def crowd():
    """Four small discs in each of the cells around the middle one, which all enter it in the first cycle."""
    bodies = []
    for i, j in [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1) if (i, j) != (0, 0)]:
        for n in range(4):
            x = i * (0.215 + 0.03 * (n % 2 if j else 0)) + (0 if i else 0.1 * n - 0.15)
            y = j * (0.215 + 0.03 * (n // 2 if i else 0)) + (0 if j else 0.1 * n - 0.15)
            bodies.append(f"    b{len(bodies)}: {{material: m, shape: disc, center: [{x:.3f}, {y:.3f}], radius: 0.01, velocity: [{-100.0 * i}, {-100.0 * j}]}}\n")
    return PIE.replace("1000.0}}}}", "100.0}}}}").format(bodies="".join(bodies))


def test_a_cell_that_more_materials_enter_than_it_holds_is_named_with_them():
    with tempfile.TemporaryDirectory() as scratch:
        deck = pathlib.Path(scratch) / "crowd.yaml"
        deck.write_text(crowd())
        r = program("run", deck, "--output", scratch + "/out")
        assert r.returncode == 3, r.returncode
        for part in ["cell 12 on rank 0; 24 have room, and at least one more comes: b0, b1, ", "; expected: smaller cells", "bodies/NAME/join"]:
            assert part in r.stderr + r.stdout, f"'{part}' is missing in:\n{r.stderr}{r.stdout}"


def test_a_mesh_that_no_memory_holds_has_its_size_in_the_message():
    command = f"ulimit -v 4000000; exec {harness.HARMOS} check {BALL} --set mesh/x/cells=23000 --set mesh/y/cells=23000"
    r = subprocess.run(["bash", "-c", command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert r.returncode == 2 and "mesh: 23000 x 23000 cells: the memory does not hold that many" in r.stderr, r.stderr


def test_blocks_are_named_and_too_large_ones_refused():
    two = ["kinematics=lagrangian", "bodies/lower/cells=[4, 4]"]
    refused(["bodies/lower/cells", "536870911"], "kinematics=lagrangian", "bodies/lower/cells=[1000000, 1000000]", deck=BLOCKS)
    refused(["bodies/lower/cells_grading", "no size"], *two, "bodies/lower/cells_grading=[1e30, 1.0]", deck=BLOCKS)
    refused(["bodies/lower", "arc of radius"], *two, "bodies/lower/arc_radii=[0.01, 0.0, 0.0, 0.0]", deck=BLOCKS)


def test_driven_rigid_bodies_that_run_into_one_another_are_told_once():
    driven = {
        "bodies/ball/motion": "prescribed", "bodies/ball/velocity": "[2000.0, 0.0]", "bodies/ball/angular_velocity": "0.0",
        "bodies/post": "{material: hard, shape: rectangle, center: [0.9, 0.5], size: [0.04, 0.9]}", "run/end_time": 4e-5,
        "bodies/plate/center": "[1.4, 0.5]",
    }
    lines = []
    for ranks in (1, 2):
        r = harmos(BALL, driven, ranks=ranks)
        lines += [w for w in r.summary["warnings"] if "run into one another" in w]
        clean(r)
    # The rim of the ball, at x = 0.86 m, reaches the post, at 0.88 m, after 10 us.
    found = [re.match(r"cycle (\d+): the rigid bodies ball and post run into", line) for line in lines]
    assert len(lines) == 2 and all(found) and lines[0] == lines[1], lines
    early = harmos(BALL, {**driven, "run/end_time": 9.9e-6})
    assert not early.summary["warnings"], early.summary["warnings"]
    clean(early)


def test_options_that_a_command_would_ignore_are_refused():
    for arguments in (("check", BALL, "--restart", "none.h5"), ("check", BALL, "--output", "x"), ("schema", "--force")):
        r = program(*arguments)
        assert r.returncode == 2 and f"takes no {arguments[-2] if len(arguments) > 3 else '--force'}" in r.stderr, r.stderr


def test_errors_are_measured_at_the_end_where_the_history_has_no_row():
    longer = {"run/max_cycles": 40, "bodies/ball/velocity": "[2000.0, 0.0]"}
    with_rows = harmos(BALL, {**longer, "output/history/every_cycles": 40})
    without = harmos(BALL, {**longer, "output/history/every_cycles": 0, "output/history/at_end": "false"})
    assert len(without["cycle"]) == 0
    errors = ("mass_error", "momentum_error", "energy_error")
    for key in errors:
        assert without.summary[key] == with_rows.summary[key], key
    # Any one of them may be zero by luck.
    assert max(without.summary[key] for key in errors) > 0.0
    clean(with_rows, without)


def test_outputs_come_by_the_rhythm_that_is_given_and_no_other():
    """Rows each 1e-4 s: the first at or after each multiple, the start and the end; nothing by cycles."""
    end, every = 5e-4, 1e-4
    still = {"bodies/ball/velocity": "[100.0, 0.0]", "run/end_time": end, "probes/p": "{position: [0.1, 0.1]}"}
    r = harmos(BALL, {**still, "output/history/every_time": every, "output/fields/every_time": every, "output/checkpoint/every_time": every})
    times, dt = r["time"], max(r["dt"])
    assert r.summary["cycles"] > 20 and len(times) == 6, (r.summary["cycles"], times)
    assert all(0 <= t - n * every < dt for n, t in enumerate(times)), times
    assert harness.read_columns(r.directory / "probes.csv")["time"] == times
    assert len(list(r.directory.glob("fields_*.h5"))) == 6
    assert int(newest_checkpoint(r.directory).stem.split("_")[1]) == r["cycle"][-1]
    clean(r)
    r = harmos(BALL, {**still, "output/history/every_wall_seconds": 1e4, "output/fields/every_wall_seconds": 1e4, "output/fields/at_end": "true"})
    assert r["time"] == [0.0, end] and len(list(r.directory.glob("fields_*.h5"))) == 2, r["time"]
    clean(r)
    r = harmos(BALL, {**still, "output/history/every_time": every, "output/history/every_cycles": 1})
    assert len(r["time"]) == r.summary["cycles"] + 1
    clean(r)


def test_summary_and_switches_of_the_output():
    r = harmos(BALL, {**SHORT, "output/fields/at_end": "true", "output/xdmf": "false"})
    assert sorted(p.name for p in r.directory.iterdir()) == ["contact.csv", "history.csv", "summary.json"]
    assert r.summary["status"] == "completed" and r.summary["ranks"] == 1
    assert 1e7 < r.summary["peak_memory_bytes"] < 1e9
    assert set(r.summary["phases"]) == {"reconstruct", "lagrange", "constrain", "remap", "exchange", "output"}
    assert r.summary["deck"]["harmos"]["run"]["max_cycles"] == 3 if "harmos" in r.summary["deck"] else \
        r.summary["deck"]["run"]["max_cycles"] == 3
    clean(r)
    r = harmos(BALL, {**SHORT, "output/fields/at_end": "true", "output/vtu": "true"})
    names = {p.name for p in r.directory.iterdir()}
    assert {"fields_000000.h5", "fields.xdmf", "fields_000000.vtu", "fields.pvd"} <= names, names
    clean(r)


def test_tracers_move_exactly_with_their_bodies():
    start = {"disc": (0.6, 0.72), "wedge": (0.88, 0.73), "matrix": (0.4, 0.55)}
    settings = {"output/fields/at_end": "false", "output/fields/every_time": 0.0, "run/end_time": 5e-4}
    for name, (x, y) in start.items():
        settings[f"tracers/in_{name}"] = f"{{position: [{x}, {y}]}}"
    settings["probes/still"] = "{position: [0.6, 0.72]}"
    settings["probes/empty"] = "{position: [1.9, 1.9]}"
    r = harmos("translation_patch/deck.yaml", settings)
    table = harness.read_columns(r.directory / "tracers.csv")
    worst = 0.0
    for time, name, x, y, material in zip(*(table[c] for c in ("time", "name", "x", "y", "material"))):
        body = name[len("in_") :]
        assert material == body
        worst = max(worst, abs(x - start[body][0] - 300.0 * time), abs(y - start[body][1] - 200.0 * time))
    check("place of the tracers", worst, 1e-10)
    assert len(table["time"]) == 3 * len(r["time"])
    probes = harness.read_columns(r.directory / "probes.csv")
    values = list(zip(*(probes[c] for c in ("name", "material", "density", "velocity_x", "velocity_y"))))
    assert all(v[1:] == ("void", 0.0, 0.0, 0.0) for v in values if v[0] == "empty")
    still = [v for v in values if v[0] == "still"]
    assert {v[1] for v in still} >= {"disc"}
    check("velocity at the probe", max(abs(v[3] - 300.0) + abs(v[4] - 200.0) for v in still if v[1] != "void"), 1e-7)
    clean(r)


def test_a_tracer_on_a_spinning_rigid_body_keeps_its_radius():
    centre, spin = (0.5, 0.5), 300.0
    settings = {
        "bodies/ball/center": "[0.5, 0.5]", "bodies/ball/velocity": "[0.0, 0.0]", "bodies/ball/angular_velocity": spin,
        "bodies/plate/center": "[1.5, 0.5]", "run/end_time": 1e-3, "tracers/rim": "{position: [0.65, 0.5]}",
    }
    r = harmos(BALL, settings)
    table = harness.read_columns(r.directory / "tracers.csv")
    radius = [((x - centre[0]) ** 2 + (y - centre[1]) ** 2) ** 0.5 for x, y in zip(table["x"], table["y"])]
    steps = max(r["dt"])
    # Each step goes along the tangent: r' = r sqrt(1 + (w dt)^2).
    check("growth of the radius", radius[-1] / radius[0] - 1.0, 0.5 * spin**2 * steps * 1e-3 * 1.001)
    clean(r)


if __name__ == "__main__":
    run(globals())
