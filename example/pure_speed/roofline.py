#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Bytes and instructions a pure cell costs in a cycle, kernel by kernel, counted by cachegrind (valgrind).

roofline.py HARMOS [--cells N] runs deck.yaml on N x N cells for 6 and for 16 cycles and takes the difference, so that
set-up drops out. The last-level cache is simulated as 1 MiB, small against the state as on the machine itself at
512 x 512. A miss on reading counts 64 bytes, one on writing 128 (the line is fetched and written back).
"""
import argparse
import pathlib
import re
import subprocess
import tempfile

EVENTS = ("Ir", "DLmr", "DLmw")
HERE = pathlib.Path(__file__).resolve().parent


def count(harmos, cells, cycles, folder):
    """Events by function of a run."""
    out = folder / f"counts.{cycles}"
    subprocess.run(
        ["valgrind", "--tool=cachegrind", "--cache-sim=yes", "--LL=1048576,16,64", f"--cachegrind-out-file={out}",
         harmos, "run", HERE / "deck.yaml", "--set", f"mesh/x/cells={cells}", "--set", f"mesh/y/cells={cells}",
         "--set", f"run/max_cycles={cycles}", "--output", folder / "run", "--force"],
        check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    columns, function, counts = [], None, {}
    for line in out.read_text().splitlines():
        if line.startswith("events:"):
            names = line.split()[1:]
            columns = [names.index(event) for event in EVENTS]
        elif line.startswith("fn="):
            function = line[3:]
        elif line[:1].isdigit():
            values = line.split()[1:]
            sums = counts.setdefault(function, [0] * len(EVENTS))
            for i, column in enumerate(columns):
                sums[i] += int(values[column])
    return counts


def short(function):
    """The part of a kernel's name that tells."""
    functor = re.search(r"(\w+Functor)", function)
    return functor.group(1) if functor else re.sub(r"\(.*", "", function.replace("(anonymous namespace)::", ""))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("harmos", help="the program")
    parser.add_argument("--cells", type=int, default=256)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        few, many = (count(options.harmos, options.cells, cycles, pathlib.Path(name)) for cycles in (6, 16))
    cell_steps = 10 * options.cells**2
    rows = []
    for function, sums in many.items():
        instructions, reads, writes = (a - b for a, b in zip(sums, few.get(function, [0] * len(EVENTS))))
        rows.append((64 * (reads + 2 * writes) / cell_steps, instructions / cell_steps, short(function)))
    print(f"{sum(r[0] for r in rows):6.0f} bytes {sum(r[1] for r in rows):6.0f} instructions a cell and cycle")
    for row in sorted(rows, reverse=True):
        if row[0] >= 5:
            print(f"{row[0]:6.0f} {row[1]:6.0f}  {row[2]}")


if __name__ == "__main__":
    main()
