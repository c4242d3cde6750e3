# SPDX-License-Identifier: BSD-3-Clause
"""A flat rigid punch with sharp corners in a perfectly plastic block: the load of Prandtl's slip lines."""
from math import pi, sqrt

from harness import ROOT, check, clean, harmos, read_columns, run

YIELD, HALF_WIDTH, SPEED = 0.3e9, 0.0967, 5.0
# Prandtl (1920); Hill, The Mathematical Theory of Plasticity (1950): p = (2 + pi) k, by von Mises k = Y / sqrt(3).
LIMIT_LOAD = (2.0 + pi) * YIELD / sqrt(3.0) * HALF_WIDTH


def load(cells):
    """Mean force over the limit load while the punch goes from 7 to 10 mm deep (half of its width: 97 mm)."""
    r = harmos(ROOT / "test/verification/decks/punch.yaml", {"mesh": f"{{x: {{from: 0.0, to: 0.5, cells: {cells}}}, y: {{from: 0.0, to: 0.4, cells: {4 * cells // 5}}}}}"})
    c = read_columns(r.directory / "contact.csv")
    steps = {t: dt for t, dt in zip(r["time"], r["dt"]) if t >= 7e-3 / SPEED}
    force = sum(abs(f) * steps[t] for t, f in zip(c["time"], c["force_y"]) if t in steps) / sum(steps.values())
    check("energy error", r.summary["energy_error"], 1e-3)
    clean(r)
    return force / LIMIT_LOAD


# With 20 cells 1.04: about of first order. (Its corners cut as chords 1.05, 1.06, 1.03.)
def test_a_flat_punch_bears_the_load_of_prandtl():
    coarse, fine = load(25), load(50)
    print(f"  load over Prandtl's with 5 and 10 cells over half of the punch: {coarse:.3f}, {fine:.3f}")
    check("with 5 cells", abs(coarse - 1.0), 0.12)
    check("with 10 cells", abs(fine - 1.0), 0.08)
    check("with 10 over with 5 cells, what is too much", (fine - 1.0) / (coarse - 1.0), 0.8)


if __name__ == "__main__":
    run(globals())
