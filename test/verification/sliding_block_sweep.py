# SPDX-License-Identifier: BSD-3-Clause
"""The sliding block at 8 and 16 cells over its height, six angles and three offsets to the mesh, unloaded and squeezed.

sliding_block_sweep.py [--jobs N] prints the table of example/sliding_block/README.md: the largest change of the momentum
along the platens over m V while the block slides its own length, the worst of the offsets. The platens are rigid, so that
the normals of contact are exact: fails where an error is above 1e-12, or a cycle's ledger is not closed.
"""
import argparse
import concurrent.futures
import itertools

from harness import check, clean, harmos
from sliding_block import ANGLES, DECK, OFFSETS, SQUEEZE, momentum_error, settings

MESHES = (8, 16)
LOADS = {"unloaded": 0.0, "squeezed": SQUEEZE}  # initial pressure [Pa]
BOUND = 1e-12  # of the change of the momentum along the platens over m V


def slide(case):
    """Momentum error, cycles without convergence, and the errors of both ledgers."""
    load, cells, angle, offset = case
    r = harmos(DECK, settings(angle, offset, cells, LOADS[load]))
    found = (momentum_error(r, angle), *(r.summary[key] for key in ("unconverged_cycles", "momentum_error", "energy_error")))
    clean(r)
    print(f"  {load}, {cells} cells, angle {angle:4.1f}, offset {offset}: {found[0]:.2e}", flush=True)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time")
    jobs = parser.parse_args().jobs
    cases = list(itertools.product(LOADS, MESHES, ANGLES, OFFSETS))
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        found = dict(zip(cases, pool.map(slide, cases)))
    columns = list(itertools.product(LOADS, MESHES))
    print("| angle | " + " | ".join(f"{load}, {cells} cells" for load, cells in columns) + " |")
    print("| --- |" + " --- |" * len(columns))
    for angle in ANGLES:
        worst = (max(found[load, cells, angle, offset][0] for offset in OFFSETS) for load, cells in columns)
        print(f"| {angle:g} | " + " | ".join(f"{error:.1e}" for error in worst) + " |")
    print(f"cycles without convergence, all runs together: {sum(values[1] for values in found.values())}")
    for load, cells in columns:
        worst = max(values[0] for case, values in found.items() if case[:2] == (load, cells))
        check(f"momentum along the platens, {load}, {cells} cells", worst, BOUND)
    check("momentum ledger", max(values[2] for values in found.values()), 1e-12)
    check("energy ledger", max(values[3] for values in found.values()), 1e-10)


if __name__ == "__main__":
    main()
