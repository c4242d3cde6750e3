# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of two and three materials over a thousand cycles: mass and momentum to round-off, the ledger closed."""
from harness import check, clean, harmos, run

THOUSAND = {"run/max_cycles": 1000, "output/fields/every_time": 0.0, "output/fields/at_end": "false", "output/history/every_cycles": 10}


def examine(deck, cycles, **more):
    r = harmos(deck, {**THOUSAND, **more})
    s = r.summary
    assert s["cycles"] >= cycles, s["cycles"]
    check(f"{deck}: mass after {s['cycles']} cycles", s["mass_error"], 1e-13)
    check(f"{deck}: momentum", s["momentum_error"], 1e-13)
    check(f"{deck}: energy ledger", s["energy_error"], 1e-12)
    return r


def test_two_material_scenes_over_a_thousand_cycles():
    clean(examine("sliding_block/deck.yaml", 1000), examine("taylor_rod/deck.yaml", 1000),
          examine("two_bars/deck.yaml", 1000, **{"run/end_time": 1.2e-3}),
          examine("translation_patch/deck.yaml", 500))


def test_third_order_moves_bodies_and_leaves_one_at_rest():
    moving = examine("translation_patch/deck.yaml", 500, **{"numerics/remap/order": 3})
    still = harmos("translation_patch/deck.yaml", {**THOUSAND, "numerics/remap/order": 3, "run/max_cycles": 100, "run/end_time": 1.0,
                                                   **{f"bodies/{name}/velocity": "[0, 0]" for name in ("matrix", "disc", "wedge")}})
    check("kinetic over elastic energy of a cell at rest", still.last("kinetic_energy") / (1000.0 * 1500.0**2), 1e-20)
    # one cell across: nothing determines derivatives along y
    strips = [examine("two_bars/deck.yaml", 150, **{"numerics/remap/order": 3, "run/max_cycles": 150,
                                                    "numerics/remap/swept_faces": swept}) for swept in ("true", "false")]
    clean(moving, still, *strips)


def test_heat_returned_by_the_remap_closes_the_total_energy():
    plain = examine("taylor_rod/deck.yaml", 1000)
    heated = examine("taylor_rod/deck.yaml", 1000, **{"numerics/remap/return_kinetic_defect": "true"})
    assert max(abs(h) for h in plain["returned_heat"]) == 0.0
    energy = heated.first("kinetic_energy")
    returned = heated["returned_heat"]
    print(f"  returned over the energy: {returned[-1] / energy:.3e}; lost without: {plain.last('remap_loss') / energy:.3e}")
    assert all(b >= a for a, b in zip(returned, returned[1:])), "the sum must grow"
    check("what is not returned, over what is lost without", abs(heated.last("remap_loss")) / plain.last("remap_loss"), 1e-10)
    check("returned against lost", abs(returned[-1] / plain.last("remap_loss") - 1.0), 0.1)
    clean(plain, heated)


if __name__ == "__main__":
    run(globals())
