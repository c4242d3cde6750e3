#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How much faster several ranks are than one, and how much of what is missing the machine takes itself.

ranks.py HARMOS [--ranks N] [--rounds R] [--set KEY=VALUE ...] runs deck.yaml R times in turn: by one rank alone on each of
N cores, by N programs of one rank beside each other, each on a core of its own, and by N ranks, and prints the wall
seconds of the cycles (the sum of the phases without output). Cores that share memory and the machine with others are
slower beside each other than alone, and not equally: with t_i the seconds of the program on core i, N ranks with equal parts
that exchange nothing and never wait but for the last take max(t_i) / N.
"""
import argparse
import json
import os
import pathlib
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def start(command, settings, folder):
    overrides = [word for setting in settings for word in ("--set", setting)]
    return subprocess.Popen([*command, "run", HERE / "deck.yaml", *overrides, "--output", folder, "--force"],
                            env=ENVIRONMENT, stdout=subprocess.DEVNULL)


def seconds(process, folder):
    """Wall seconds of the cycles of a run that started as process, once it has ended."""
    if process.wait() != 0:
        raise SystemExit(f"a run failed with status {process.returncode}")
    phases = json.loads((folder / "summary.json").read_text())["phases"]
    return sum(value for phase, value in phases.items() if phase != "output")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("harmos", help="the program")
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="handed to harmos")
    options = parser.parse_args()
    cores = range(options.ranks)
    print(f"alone on each core | beside each other | {options.ranks} ranks | one alone over {options.ranks} ranks | "
          f"slowest beside / {options.ranks} over {options.ranks} ranks")
    with tempfile.TemporaryDirectory() as name:
        folders = [pathlib.Path(name) / str(core) for core in cores]
        on = [["taskset", "--cpu-list", str(core), options.harmos] for core in cores]
        for _ in range(options.rounds):
            alone = [seconds(start(on[core], options.set, folders[core]), folders[core]) for core in cores]
            running = [start(on[core], options.set, folders[core]) for core in cores]
            beside = [seconds(running[core], folders[core]) for core in cores]
            mpi = ["mpiexec", "--bind-to", "core", "-n", str(options.ranks), options.harmos]
            together = seconds(start(mpi, options.set, folders[0]), folders[0])
            print(" ".join(f"{t:.2f}" for t in alone), "|", " ".join(f"{t:.2f}" for t in beside), f"| {together:.2f} |",
                  f"{min(alone) / together:.2f} | {max(beside) / options.ranks / together:.2f}", flush=True)


if __name__ == "__main__":
    main()
