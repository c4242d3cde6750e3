# SPDX-License-Identifier: BSD-3-Clause
"""Compare two runs: the state of their checkpoints bit for bit, their histories to round-off."""
from math import sqrt

import h5py
import numpy

from harness import check, clean, harmos

# Of the largest value in the run, or of the scale that the column is a small difference of. Sums over cells are made
# by each rank and then over ranks: another order of additions, some 1e4 of them, each good to 1.1e-16.
ROUND_OFF = 1e-12


def newest_checkpoint(directory):
    return sorted(directory.glob("checkpoint_*.h5"))[-1]


def same_state(a, b):
    """Assert that two checkpoints hold the same bits, whatever the number of ranks that wrote them."""
    with h5py.File(a) as left, h5py.File(b) as right:
        names = [f"pairs/{name}" for name in ("cell", "material", "record", "centroid", "corner_velocity")]
        assert ("nodes" in left) == ("nodes" in right), "only one of the meshes moves"
        assert ("pairs/damage" in left) == ("pairs/damage" in right), "only one of the runs tracks damage"
        names += ["pairs/damage"] if "pairs/damage" in left else []
        moving = ["nodes/global", "nodes/position"] if "nodes" in left else []
        for name in names + moving + ["time_and_steps"] + (["bodies"] if "bodies" in left else []):
            x, y = left[name][...], right[name][...]
            assert x.shape == y.shape, f"{name}: {x.shape} and {y.shape}"
            differ = numpy.argwhere(x != y)
            assert len(differ) == 0, f"{name}: {len(differ)} values differ, the first at {differ[0]}: " + \
                f"{x[tuple(differ[0])]!r}, {y[tuple(differ[0])]!r}"


def scale_of(column, run):
    """What a column of the history is measured against."""
    top = lambda name: max(abs(v) for v in run[name])
    energy = top("kinetic_energy") + top("internal_energy")
    momentum = sqrt(2.0 * energy * top("mass"))
    for words, scale in (
        (("energy", "work", "loss", "heat"), energy),
        (("angular_momentum",), momentum * size_of(run)),
        (("momentum", "impulse"), momentum),
        (("volume",), size_of(run) ** 2),
    ):
        if any(word in column for word in words):
            return scale
    return top(column)


def size_of(run):
    """Extent of all materials."""
    ends = [abs(v) for name in run.history if name.endswith(("_max", "_min")) and "strain" not in name for v in run[name]]
    return max(ends)


def same_history(a, b):
    """Largest difference of two histories over each column's scale; steering numbers must be equal."""
    worst, where = 0.0, ""
    assert a.history.keys() == b.history.keys()
    for column, left in a.history.items():
        right = b.history[column]
        assert len(left) == len(right), f"{column}: {len(left)} and {len(right)} rows"
        if column in ("cycle", "time", "dt", "pairs", "pairs_mixed", "multipliers", "iterations", "residual") or \
                column.startswith(("polygon_overlap", "remapped_overlap")):
            assert left == right, f"{column} differs"
            continue
        scale = scale_of(column, a)
        difference = max(abs(x - y) for x, y in zip(left, right))
        if scale > 0.0 and difference / scale > worst:
            worst, where = difference / scale, column
        assert scale > 0.0 or difference == 0.0, column
    return worst, where


def same_on_ranks(one, deck, settings, ranks=(2, 4)):
    """Run a deck on these numbers of ranks too: the state of run `one` bit for bit, its history to round-off."""
    for n in ranks:
        several = harmos(deck, settings, ranks=n)
        assert several.summary["ranks"] == n
        same_state(newest_checkpoint(one.directory), newest_checkpoint(several.directory))
        worst, column = same_history(one, several)
        check(f"{n} ranks: history, worst in {column}", worst, ROUND_OFF)
        clean(several)
