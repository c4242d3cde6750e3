# SPDX-License-Identifier: BSD-3-Clause
"""Closure of mixed cells in `single`: compressibility-weighted, void first, beside equal strain."""
import pathlib
from math import sqrt

from compare import same_on_ranks
from harness import check, clean, harmos, read_columns, run
from sliding_block import SQUEEZE, settings

HERE = pathlib.Path(__file__).resolve().parent
LAYERS = HERE / "decks/layers.yaml"
V = 5.0
RHO = {"stiff": 8000.0, "soft": 1000.0}
K = {"stiff": 8000.0 * 4000.0**2, "soft": 1000.0 * 1500.0**2}
F = {"stiff": 0.6, "soft": 0.4}
MEAN_RHO = sum(F[m] * RHO[m] for m in F)


def probe_pressures(r):
    """Pressure of both layers behind the wave at the end."""
    columns = read_columns(r.directory / "probes.csv")
    last = max(columns["cycle"])
    rows = [i for i, cycle in enumerate(columns["cycle"]) if cycle == last]
    return {columns["name"][i]: columns["pressure"][i] for i in rows}


def ledger(r):
    check("energy error", r.summary["energy_error"], 1e-10)
    check("mass error", r.summary["mass_error"], 1e-12)


def test_layers_that_share_cells_get_the_pressure_of_the_mixture():
    r = harmos(LAYERS)
    p = probe_pressures(r)
    exact = MEAN_RHO * V / sqrt(MEAN_RHO * sum(F[m] / K[m] for m in F))
    check("pressure of the stiff layer", abs(p["stiff"] / exact - 1.0), 0.01)
    check("pressure of the soft layer", abs(p["soft"] / exact - 1.0), 0.01)
    check("difference of both", abs(p["stiff"] / p["soft"] - 1.0), 0.01)
    ledger(r)
    clean(r)


def test_equal_strain_gives_the_ratio_of_moduli():
    r = harmos(LAYERS, {"numerics/closure": "equal strain"})
    p = probe_pressures(r)
    check("ratio of pressures over that of moduli", abs(p["stiff"] / p["soft"] / (K["stiff"] / K["soft"]) - 1.0), 0.01)
    exact = V * sqrt(MEAN_RHO * sum(F[m] * K[m] for m in F))
    check("mean pressure", abs(sum(F[m] * p[m] for m in F) / exact - 1.0), 0.01)
    clean(r)


def test_void_closes_before_anything_is_compressed():
    """A layer of void, 2% of every cell: a front that closes it runs ahead of any pressure. Jump conditions with a
    mixture that is stiff against it: front speed U = V/s, p = rho U V, s = void + p * sum of f / K."""
    void, speed = 0.02, 20.0
    bodies = {"bodies/soft/center": f"[1.0, {0.008 + 0.01 * void / 2}]", "bodies/soft/size": f"[2.0, {0.004 - 0.01 * void}]"}
    for name in F:
        bodies[f"bodies/{name}/velocity"] = f"[{-speed}, 0.0]"
    r = harmos(LAYERS, {**bodies, "run/end_time": 4.0e-4, "probes/ahead": "{position: [0.5, 0.009]}"})
    f = {"stiff": 0.6, "soft": 0.4 - void}
    rho, compressibility = sum(f[m] * RHO[m] for m in f), sum(f[m] / K[m] for m in f)
    p = 0.0
    for _ in range(50):
        p = rho * speed**2 / (void + p * compressibility)
    measured = probe_pressures(r)
    check("pressure of the soft layer", abs(measured["soft"] / p - 1.0), 0.03)
    check("pressure of the stiff layer", abs(measured["stiff"] / p - 1.0), 0.03)
    check("pressure ahead of the front", abs(measured["ahead"]) / p, 1e-9)
    ledger(r)
    clean(r)


def test_scenes_run_with_it():
    both = {"kinematics": "single", "numerics/closure": "compressibility", "output/fields/every_time": 0.0}
    for deck, more in (("two_bars/deck.yaml", {}), ("sliding_block/deck.yaml", settings(15.0, (0.31, 0.17), 8, SQUEEZE))):
        r = harmos(deck, {**more, **both})
        print(f"  {deck}: {r.summary['cycles']} cycles")
        ledger(r)
        clean(r)


def test_ranks_agree():
    common = {"kinematics": "single", "numerics/closure": "compressibility", "output/fields/every_time": 0.0,
              "output/fields/at_end": "false", "run/max_cycles": 60, "output/checkpoint/at_end": "true"}
    deck = "sliding_block/deck.yaml"
    block = settings(15.0, (0.31, 0.17), 8, SQUEEZE)
    one = harmos(deck, {**block, **common})
    same_on_ranks(one, deck, {**block, **common})
    clean(one)


def test_other_kinematics_are_refused():
    for kinematics in ("xfem", "lagrangian"):
        r = harmos(LAYERS, {"kinematics": kinematics}, expect=2)
        assert "numerics/closure" in r.text and "single" in r.text, r.text


if __name__ == "__main__":
    run(globals())
