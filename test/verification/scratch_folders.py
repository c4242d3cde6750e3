# SPDX-License-Identifier: BSD-3-Clause
"""What test scripts leave behind: nothing when they pass, their results when they fail."""
import pathlib
import subprocess
import sys
import tempfile

from harness import run

HERE = pathlib.Path(__file__).resolve().parent
SCRIPT = """import pathlib
import sys
sys.path.insert(0, {here!r})
from harness import run, scratch_folder

def test_that_leaves_two_folders():
    one, two = scratch_folder(), scratch_folder()
    assert one != two
    for folder in (one, two, pathlib.Path(str(one) + "-copy")):
        folder.mkdir(exist_ok=True)
        (folder / "history.csv").write_text("time")
    {end}

{last}
"""


def leaves(end, last, status):
    """Files below the temporary folder of a script whose test ends with the statement `end` and itself with `last`, and its text."""
    with tempfile.TemporaryDirectory() as folder:
        script = pathlib.Path(folder) / "script.py"
        script.write_text(SCRIPT.format(here=str(HERE), end=end, last=last))
        temporary = pathlib.Path(folder) / "temporary"
        temporary.mkdir()
        done = subprocess.run([sys.executable, script], env={"TMPDIR": str(temporary)}, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        assert done.returncode == status, done.stdout
        kept = [line for line in done.stdout.splitlines() if line.startswith("results are kept in ")]
        assert bool(kept) == bool(status), done.stdout
        for line in kept:
            assert pathlib.Path(line.split(" in ")[1]).is_dir(), line
        return len(list(temporary.rglob("history.csv"))), len(list(temporary.iterdir()))


def test_a_script_that_passes_leaves_nothing():
    assert leaves("pass", "run(globals())", 0) == (0, 0)
    assert leaves("pass", "test_that_leaves_two_folders()", 0) == (0, 0)


def test_a_script_that_fails_keeps_its_results_in_one_folder():
    assert leaves("assert False", "run(globals())", 1) == (3, 1)
    assert leaves("assert False", "test_that_leaves_two_folders()", 1) == (3, 1)


if __name__ == "__main__":
    run(globals())
