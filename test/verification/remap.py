# SPDX-License-Identifier: BSD-3-Clause
"""The remap alone (`harmos remap`): cyclic and random meshes, against a peer program's figures and the comparators.

Peer: Portage on the same meshes, fields and steps (Barth & Jespersen's limiter, intersection).
"""
import subprocess

from harness import EXAMPLE, HARMOS, check, read_columns, run, scratch_folder


def remap(deck="deck.yaml", ranks=1, expect=0, **settings):
    """Columns of remap.csv; settings are keys of the deck."""
    directory = scratch_folder()
    command = [HARMOS, "remap", str(EXAMPLE / "remap" / deck), "--output", str(directory), "--force"]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    if ranks > 1:
        command = ["mpiexec", "--oversubscribe", "--allow-run-as-root", "-n", str(ranks)] + command
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != expect:
        raise AssertionError(f"exit status {done.returncode}, expected {expect}:\n{done.stdout[-2000:]}")
    return read_columns(directory / "remap.csv") if expect == 0 else done.stdout


def conserves_within_range(what, r):
    check(f"{what}: conservation", max(abs(c) for c in r["conservation"]), 1e-13)
    check(f"{what}: beyond the initial range", max(r["below"] + r["above"]), 1e-12)


def test_cyclic_remapping_beats_the_peer_limited_and_stays_in_range():
    # motion, field: the peer's L1 at 32, limited
    for motion, field, peer in [("tensor", "sine", 2.08e-2), ("smooth", "sine", 6.71e-3), ("tensor", "shock", 4.00e-2), ("smooth", "shock", 1.19e-2)]:
        for scheme in ["swept", "intersection"]:
            r = remap(motion=motion, field=field, scheme=scheme, cells="[32.0]")
            check(f"{motion}, {field}, {scheme}: L1", r["L1"][0], peer)
            conserves_within_range(f"{motion}, {field}, {scheme}", r)


def test_cyclic_remapping_within_range_is_hardly_worse_than_without_limiter():
    # half the error of the peer's limited remap of 64 x 64 cells, and a third
    for scheme in ["intersection", "field intersection"]:
        for motion, bound in [("tensor", 2.5e-3), ("smooth", 6e-4)]:
            r = remap(motion=motion, scheme=scheme, cells="[64.0]")
            check(f"{motion}, sine, {scheme}: L1", r["L1"][0], bound)
            conserves_within_range(f"{motion}, {scheme}", r)


def test_third_order_on_random_meshes():
    # parts of the error of the peer, which is of second order
    for scheme in ["swept", "intersection"]:
        r = remap("random.yaml", scheme=scheme, order=3, cells="[32.0, 64.0, 128.0]")
        for error, peer, part in zip(r["L1"], [2.19e-4, 4.39e-5, 1.03e-5], [0.67, 0.33, 0.17]):
            check(f"third order, {scheme}: L1", error, part * peer)
        check(f"third order, {scheme}: slope below 3 by", 3.0 - r["order_L1"][2], 0.2)
        conserves_within_range(f"third order, {scheme}, random", r)
        r = remap(scheme=scheme, order=3, cells="[32.0]")
        conserves_within_range(f"third order, {scheme}", r)
        r = remap(scheme=scheme, field="shock", cells="[32.0]")
        conserves_within_range(f"{scheme}, shock", r)


def test_rings_are_remapped_as_planar_cells_are():
    # axisymmetric: averages weighted by the radius. Bounds: the peer's planar figures
    for scheme in ["swept", "intersection"]:
        for motion, peer in [("tensor", 2.08e-2), ("smooth", 6.71e-3)]:
            r = remap(geometry="axisymmetric", motion=motion, scheme=scheme, cells="[32.0]")
            check(f"rings, {motion}, {scheme}: L1", r["L1"][0], peer)
            conserves_within_range(f"rings, {motion}, {scheme}", r)
            check(f"rings, {motion}, {scheme}: axial momentum", r["momentum"][0], 1e-13)
    r = remap("random.yaml", geometry="axisymmetric", cells="[32.0, 64.0, 128.0]")
    for error, peer in zip(r["L1"], [2.19e-4, 4.39e-5, 1.03e-5]):
        check("rings, random: L1", error, peer)
    for scheme in ["swept", "intersection"]:
        r = remap("random.yaml", geometry="axisymmetric", scheme=scheme, order=3, limiter="none", cells="[32.0, 64.0, 128.0]")
        check(f"rings, third order, {scheme}: slope below 3 by", 3.0 - r["order_L1"][2], 0.2)
        r = remap(geometry="axisymmetric", scheme=scheme, order=3, cells="[32.0]")
        check(f"rings, third order, {scheme}: L1", r["L1"][0], 2.08e-2)
        conserves_within_range(f"rings, third order, {scheme}", r)


def test_the_field_alone_on_random_meshes():
    r = remap("random.yaml", scheme="field intersection", cells="[32.0, 64.0, 128.0]")
    for error, peer in zip(r["L1"], [2.19e-4, 4.39e-5, 1.03e-5]):
        check("random, L1", error, peer)
    r = remap("random.yaml", scheme="field intersection", carrier="density", cells="[32.0]")
    conserves_within_range("random, density", r)


def test_cyclic_remapping_without_limiter():
    for motion, peer in [("tensor", 1.27e-2), ("smooth", 2.60e-3)]:
        for scheme in ["swept", "intersection"]:
            r = remap(motion=motion, scheme=scheme, limiter="none", cells="[32.0]")
            check(f"{motion}, sine, {scheme}: L1", r["L1"][0], 1.1 * peer)


def test_random_meshes_orders_of_accuracy():
    for scheme, peers in [("intersection", [2.19e-4, 4.39e-5, 1.03e-5, 2.51e-6]), ("swept", [3.22e-4, 7.05e-5, 1.77e-5, 4.39e-6])]:
        r = remap("random.yaml", scheme=scheme, cells="[32.0, 64.0, 128.0, 256.0]")
        for error, peer in zip(r["L1"], peers):
            check(f"L1, {scheme}, second order limited", error, peer)
        conserves_within_range(f"random, {scheme}", r)
    r = remap("random.yaml", order=1, cells="[32.0, 64.0]")
    for error, peer in zip(r["L1"], [3.74e-3, 1.66e-3]):
        check("L1, first order", error, 1.1 * peer)  # other random numbers


def test_any_number_of_ranks_gives_the_same_errors():
    for scheme, order, geometry in [("intersection", 2, "planar"), ("field intersection", 2, "planar"), ("swept", 3, "planar"), ("intersection", 3, "axisymmetric")]:
        one, two, four = (remap(cells="[32.0]", scheme=scheme, order=order, geometry=geometry, ranks=n) for n in (1, 2, 4))
        for r in two, four:
            for column in ["L1", "L2"]:
                check(f"{scheme}, order {order}: {column} on more ranks", abs(r[column][0] / one[column][0] - 1.0), 1e-12)
            for column in ["Linf", "below", "above"]:
                check(f"{scheme}, order {order}: {column} on more ranks", abs(r[column][0] - one[column][0]), 0.0)


def test_interpolation_loses_conservation():
    r = remap(scheme="interpolation", field="shock", motion="smooth", cells="[32.0]")
    print(f"  relative change of the sum: {r['conservation'][0]:.2e}")
    assert abs(r["conservation"][0]) > 1e-4


def test_consistent_projection_leaves_the_range_and_lumped_smears():
    r = remap(scheme="consistent projection", field="shock", motion="smooth", cells="[32.0]")
    print(f"  below {r['below'][0]:.2e}, above {r['above'][0]:.2e}")
    check("conservation", abs(r["conservation"][0]), 1e-12)
    assert min(r["below"][0], r["above"][0]) > 1e-2
    lumped = remap(scheme="lumped projection", order=1, field="shock", motion="smooth", cells="[32.0]")
    check("lumped: conservation", abs(lumped["conservation"][0]), 1e-12)
    # as far as three points a triangle integrate N_i
    check("lumped, constant donors: beyond the range", max(lumped["below"] + lumped["above"]), 1e-4)
    assert lumped["L1"][0] > 2.0 * r["L1"][0]


def test_what_makes_no_sense_is_refused():
    assert "expected" in remap(scheme="interpolation", ranks=2, cells="[8.0]", expect=2)
    assert "positive" in remap(carrier="density", expect=2)
    assert "ascending" in remap(cells="[32.0, 16.0]", expect=2)
    assert "expected" in remap(scheme="interpolation", limiter="none", expect=2)
    assert "intersection" in remap(scheme="interpolation", order=3, expect=2)
    assert "intersection" in remap(scheme="field intersection", order=3, expect=2)
    assert "expected" in remap(scheme="field intersection", limiter="van leer", expect=2)
    assert "expected" in remap(scheme="field intersection", geometry="axisymmetric", expect=2)
    assert "unknown" in remap(limitor="none", expect=2).lower()


if __name__ == "__main__":
    run(globals())
