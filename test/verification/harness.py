# SPDX-License-Identifier: BSD-3-Clause
"""Run decks with the harmos program and read what it leaves. Used by every verification test.

A test is a Python file of functions named test_*; run(globals()) calls them all and exits non-zero if one fails.
What runs leave lies in a folder of the script's (scratch_folder), which goes at the end unless something failed.
"""
import atexit
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import traceback

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLE = ROOT / "example"
HARMOS = os.environ.get("HARMOS", str(ROOT / "build/native/src/harmos"))
SCRATCH = {"lock": threading.Lock(), "folder": None, "failed": False}  # the script's own folder, made when first needed


class Run:
    """One finished run: exit status, printed text, history columns as lists of floats, summary."""

    def __init__(self, directory, status, text):
        self.directory = pathlib.Path(directory)
        self.status = status
        self.text = text
        self.history = {}
        self.summary = {}
        history = self.directory / "history.csv"
        if history.exists():
            self.history = read_columns(history)
        summary = self.directory / "summary.json"
        if summary.exists():
            self.summary = json.loads(summary.read_text())

    def __getitem__(self, column):
        return self.history[column]

    def first(self, column):
        return self.history[column][0]

    def last(self, column):
        return self.history[column][-1]

    def time_of_velocities(self):
        """Of the last ones: momentum, kinetic energy and work stand half a step behind positions."""
        return self.last("time") - 0.5 * self.last("dt")


def read_columns(path):
    """Columns of a CSV file by name; numbers where they are numbers."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    columns = {}
    for i, name in enumerate(rows[0]):
        values = [row[i] for row in rows[1:]]
        try:
            columns[name] = [float(v) for v in values]
        except ValueError:
            columns[name] = values
    return columns


def scratch_folder():
    """A new empty folder (pathlib.Path) in the script's own, which is removed at the script's end.

    It stays, and its path is printed, when a test failed or the script ended by an exception. What is put beside the
    folder returned goes with it.
    """
    with SCRATCH["lock"]:
        if SCRATCH["folder"] is None:
            SCRATCH["folder"] = tempfile.mkdtemp(prefix=f"harmos-{pathlib.Path(sys.argv[0]).stem}-")
            atexit.register(leave_scratch)
    return pathlib.Path(tempfile.mkdtemp(dir=SCRATCH["folder"]))


def leave_scratch():
    if SCRATCH["failed"] or hasattr(sys, "last_type"):  # the latter: an exception that nobody caught
        print(f"results are kept in {SCRATCH['folder']}")
    else:
        shutil.rmtree(SCRATCH["folder"])


def launcher(ranks):
    return ["mpiexec", "--oversubscribe", "--allow-run-as-root", "-n", str(ranks)] if ranks > 1 else []


def harmos(deck, settings=None, ranks=1, directory=None, extra=(), expect=0):
    """Run a deck (path under example/) with overrides {'path/to/key': value}; assert its exit status."""
    directory = directory or scratch_folder()
    command = [HARMOS, "run", str(EXAMPLE / deck), "--output", str(directory), "--force"]
    for key, value in (settings or {}).items():
        command += ["--set", f"{key}={value}"]
    command += list(extra)
    command = launcher(ranks) + command
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if expect is not None and done.returncode != expect:
        print(" ".join(command))
        print(done.stdout[-4000:])
        raise AssertionError(f"exit status {done.returncode}, expected {expect}")
    return Run(directory, done.returncode, done.stdout)


def check(what, value, bound):
    """Print a measured value beside its bound; fail when it is not below."""
    good = value <= bound
    print(f"  {'ok  ' if good else 'FAIL'} {what}: {value:.3e} (at most {bound:.1e})")
    if not good:
        raise AssertionError(f"{what}: {value:.6e} > {bound:.1e}")


def run(names):
    """Call every test_* function of a module; exit 1 when one fails."""
    only = sys.argv[1:]
    failed = []
    count = 0
    for name, function in list(names.items()):
        if not name.startswith("test_") or (only and name not in only):
            continue
        count += 1
        start = time.time()
        print(name, flush=True)
        try:
            function()
        except Exception:
            traceback.print_exc(file=sys.stdout)
            failed.append(name)
        print(f"  {time.time() - start:.1f} s", flush=True)
    if count == 0:
        print("no test ran")
        sys.exit(1)
    if failed:
        SCRATCH["failed"] = True
        print("failed: " + ", ".join(failed))
        sys.exit(1)


def clean(*runs):
    for r in runs:
        shutil.rmtree(r.directory, ignore_errors=True)
