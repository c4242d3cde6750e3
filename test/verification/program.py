# SPDX-License-Identifier: BSD-3-Clause
"""What the program answers: messages, exit status, what it writes and what it leaves alone."""
import json
import pathlib
import re
import subprocess
import tempfile

import harness
from compare import newest_checkpoint
from harness import check, clean, harmos, run

HERE = pathlib.Path(__file__).resolve().parent
BALL, BLOCKS = HERE / "rigid_ball.yaml", HERE / "two_blocks.yaml"
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


def test_overlapping_bodies_are_one_line_on_any_number_of_ranks():
    overlap = "bodies/ball/center=[0.9, 0.5]"
    refused(["cell", "plate", "ball", "overlap"], overlap)
    refused(["cell", "plate", "ball", "overlap"], overlap, ranks=3)
    refused(["run/end_tme"], "run/end_tme=1.0", ranks=3)


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


def test_a_time_step_that_is_too_small_names_its_pair_on_any_rank():
    lines = []
    for ranks in (1, 3):
        r = harmos(BALL, {"run/end_time": 1e6}, ranks=ranks, expect=3)
        said = [text for text in r.text.splitlines() if text.startswith("harmos:")]
        assert len(said) == 1, r.text
        lines.append(said[0])
        clean(r)
    pattern = r"the time step (\S+e-06) s is too small: set by (cell \d+) on rank \d, (material plate)"
    found = [re.search(pattern, line) for line in lines]
    assert all(found), lines
    assert found[0].groups() == found[1].groups(), lines
    print("  " + lines[1])


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
