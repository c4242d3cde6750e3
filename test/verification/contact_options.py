# SPDX-License-Identifier: BSD-3-Clause
"""Every key of numerics/constraint and interactions does something; what cannot work together is refused with the key's path."""
import pathlib
import tempfile

from harness import clean, harmos, run
from sliding_block import DECK, SQUEEZE, settings

PLUG = pathlib.Path(__file__).resolve().parent / "decks/plug.yaml"
START = {**settings(15.0, (0.31, 0.17), 8, SQUEEZE), "run/max_cycles": 25}
CONSTRAINT = "numerics/constraint"
ALTERNATIVES = {
    "method penalty": {CONSTRAINT: "{method: penalty}"},
    "penalty of penalty": {CONSTRAINT: "{method: penalty, penalty: 0.5}"},
    "method nitsche": {CONSTRAINT: "{method: nitsche}"},
    "penalty of nitsche": {CONSTRAINT: "{method: nitsche, penalty: 0.5}"},
    "method nodal": {CONSTRAINT: "{method: nodal}"},
    "method merged": {CONSTRAINT: "{method: merged}"},
    "gauss points": {CONSTRAINT: "{placement: gauss points}"},
    "segment ends": {CONSTRAINT: "{placement: segment ends}"},
    "vital vertices": {CONSTRAINT: "{placement: vital vertices}"},
    "mortar": {CONSTRAINT: "{placement: mortar}"},
    "conjugate gradients": {CONSTRAINT: "{solver: conjugate gradients}"},
    "row sums": {CONSTRAINT: "{solver: row sums}"},
    "warm start": {CONSTRAINT: "{warm_start: true}"},
    "warm start, conjugate gradients": {CONSTRAINT: "{solver: conjugate gradients, warm_start: true}"},
    "warm start, row sums": {CONSTRAINT: "{solver: row sums, warm_start: true}"},
    "tolerance": {CONSTRAINT: "{tolerance: 1.0e-3, solver: conjugate gradients}"},
    "max_iterations": {CONSTRAINT: "{max_iterations: 1}"},
    "shortest_segment": {CONSTRAINT: "{shortest_segment: 0.5}"},
    "exposed_face": {CONSTRAINT: "{exposed_face: 0.0, shortest_segment: 0.0}"},
    "shortest_segment 0": {CONSTRAINT: "{shortest_segment: 0.0}"},
    "bonded": {"interactions": "{default: bonded}"},
    "tensile strength": {"interactions": "{default: bonded, tensile_strength: 1.0e6}"},
    "shear strength": {"interactions": "{default: bonded, shear_strength: 1.0e6}"},
    "friction": {"interactions": "{default: friction, coefficient: 0.1}"},
    "coefficient": {"interactions": "{default: friction, coefficient: 0.2}"},
    "restitution": {"interactions": "{default: sliding, restitution: 1.0}"},
    "an exception": {"interactions": "{one: {between: block, and: upper, type: bonded}}"},
    "its coefficient": {"interactions": "{one: {between: block, and: upper, type: friction, coefficient: 0.1}}"},
    "its strengths": {"interactions": "{one: {between: block, and: upper, type: bonded, tensile_strength: 1.0e6, shear_strength: 2.0e6}}"},
}


def traces(r):
    """What a run leaves of contact: motion, loss, rows, iterations."""
    columns = ("block.momentum_x", "block.momentum_y", "contact_loss", "multipliers", "iterations")
    return tuple(tuple(r[name]) for name in columns) + (r.summary["unconverged_cycles"],)


def test_every_key_changes_what_is_computed():
    r = harmos(DECK, START)
    seen = {traces(r): "the defaults"}
    clean(r)
    for name, keys in ALTERNATIVES.items():
        r = harmos(DECK, {**START, **keys})
        found = traces(r)
        clean(r)
        assert found not in seen, f"{name}: the same as {seen[found]}"
        seen[found] = name
    print(f"  {len(seen)} ways, each another run")


def test_methods_without_a_solve_tell_by_how_much_they_miss():
    """The residual is the largest closing velocity that is left over the largest one without impulses."""
    for method, low, high in (("multipliers", 0.0, 1e-8), ("penalty", 1e-3, 10.0), ("nitsche", 1e-3, 10.0)):
        r = harmos(DECK, {**START, CONSTRAINT: f"{{method: {method}}}"})
        most = max(r["residual"])
        print(f"  {method}: {most:.2e}")
        assert low <= most <= high, f"{method}: {most}"
        clean(r)


def test_contact_that_stays_closed_takes_no_energy():
    """A plug under pressure in its hole rings; points that share a multiplier leave no gaps to their neighbours' cost."""
    for placement in ("midpoint", "gauss points", "vital vertices", "mortar"):
        r = harmos(PLUG, {f"{CONSTRAINT}/placement": placement})
        loss = max(map(abs, r["contact_loss"])) / max(r["kinetic_energy"])
        print(f"  {placement}: contact takes {loss:.1e} of the largest kinetic energy")
        assert loss < 0.02, (placement, loss)
        clean(r)


def test_a_run_says_that_contact_gave_energy():
    for method, gives in (("multipliers", False), ("penalty, penalty: 1.0", False), ("penalty, penalty: 10.0", True)):
        r = harmos(DECK, {**START, CONSTRAINT: f"{{method: {method}}}"})
        told = any("contact gave energy" in text for text in r.summary["warnings"])
        print(f"  {method}: contact_loss {r.last('contact_loss'):.2e}, {'a' if told else 'no'} warning")
        assert told == gives, f"{method}: {r.summary['warnings']}"
        clean(r)


def test_what_cannot_work_together_is_refused():
    cases = {
        "bonds that break, nodal": ({CONSTRAINT: "{method: nodal}", "interactions": "{default: bonded, tensile_strength: 1.0e6}"}, "numerics/constraint/method"),
        "bonds that break, merged": ({CONSTRAINT: "{method: merged}", "interactions": "{default: bonded, shear_strength: 1.0e6}"}, "numerics/constraint/method"),
        "contact wall, nodal": ({CONSTRAINT: "{method: nodal}", "boundaries/left": "{type: contact wall}"}, "boundaries/left/type"),
        "friction, merged": ({CONSTRAINT: "{method: merged}", "interactions": "{default: friction, coefficient: 0.1}"}, "numerics/constraint/method"),
        "free rigid body, penalty": ({CONSTRAINT: "{method: penalty}", "bodies/block/material": "platen", "bodies/block/motion": "free"}, "numerics/constraint/method"),
        "penalty with multipliers": ({CONSTRAINT: "{penalty: 2.0}"}, "numerics/constraint/penalty"),
        "placement with penalty": ({CONSTRAINT: "{method: penalty, placement: mortar}"}, "numerics/constraint/placement"),
        "restitution with penalty": ({CONSTRAINT: "{method: penalty}", "interactions": "{default: sliding, restitution: 0.5}"}, "numerics/constraint/method"),
        "restitution of a bond": ({"interactions": "{default: bonded, restitution: 0.5}"}, "interactions/restitution"),
        "tolerance without a solve": ({CONSTRAINT: "{method: penalty, tolerance: 1.0e-6}"}, "numerics/constraint/tolerance"),
        "iterations without a solve": ({CONSTRAINT: "{method: nitsche, max_iterations: 3}"}, "numerics/constraint/max_iterations"),
        "a solver without a solve": ({CONSTRAINT: "{method: penalty, solver: row sums}"}, "numerics/constraint/solver"),
        "warm start without a solve": ({CONSTRAINT: "{method: nitsche, warm_start: true}"}, "numerics/constraint/warm_start"),
        "warm start of groups": ({CONSTRAINT: "{placement: mortar, warm_start: true}"}, "numerics/constraint/warm_start"),
        "segments at nodes": ({CONSTRAINT: "{method: nodal, shortest_segment: 0.3}"}, "numerics/constraint/shortest_segment"),
        "faces at nodes": ({CONSTRAINT: "{method: merged, exposed_face: 0.1}"}, "numerics/constraint/exposed_face"),
        "two exceptions for one pair": ({"interactions": "{one: {between: block, and: upper, type: bonded}, two: {between: upper, and: block, type: sliding}}"}, "interactions/two"),
        "an exception for a body with itself": ({"interactions": "{one: {between: block, and: block, type: bonded}}"}, "interactions/one"),
        "an exception for two driven bodies": ({"bodies/block/material": "platen", "bodies/block/motion": "prescribed", "interactions": "{one: {between: block, and: upper, type: bonded}}"}, "interactions/one"),
        "an exception for no body": ({"interactions": "{one: {between: block, and: nobody, type: bonded}}"}, "interactions/one/and"),
    }
    for name, (keys, path) in cases.items():
        with tempfile.TemporaryDirectory() as scratch:
            out = pathlib.Path(scratch) / "out"
            r = harmos(DECK, {**settings(15.0, (0.31, 0.17), 8), "run/max_cycles": 5, **keys}, directory=out, expect=2)
            assert r.text.count("\n") == 1 and path in r.text, f"{name}: {r.text}"
            assert not out.exists(), f"{name}: something was written"


def test_every_placement_gives_way_to_walls_that_hold_everything_across():
    # A single row of cells between slip walls: nothing can move across the interface's normal, and groups of rows have no mass there.
    for interactions in ("{default: bonded}", "{default: friction, coefficient: 0.3}"):
        found = {}
        for placement in ("midpoint", "vital vertices", "mortar"):
            r = harmos("two_bars/deck.yaml", {f"{CONSTRAINT}/placement": placement, "interactions": interactions})
            found[placement] = r.last("left.momentum_x")
            clean(r)
        print(f"  {interactions}: {found}")
        for placement, momentum in found.items():
            assert abs(momentum / found["midpoint"] - 1.0) < 1e-5, (placement, momentum)


if __name__ == "__main__":
    run(globals())
