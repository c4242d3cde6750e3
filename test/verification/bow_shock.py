# SPDX-License-Identifier: BSD-3-Clause
"""A stream at Mach 3 against rigid bodies in the cells: where the shock stands, what the nose bears."""
import sys

from harness import EXAMPLE, check, clean, harmos, run

sys.path.insert(0, str(EXAMPLE / "bow_shock"))
import measure  # noqa: E402


def shock_stands(deck, end_time):
    r = harmos(f"bow_shock/{deck}.yaml", {"run/end_time": end_time})
    geometry, stand_off, nose = measure.measure(r.directory)
    print(f"  {deck}: stand-off {stand_off:.3f} of {measure.STAND_OFF[geometry]:.3f}, nose {nose:.2f} of "
          f"{measure.STAGNATION:.2f}")
    check("stand-off beside Billig's", abs(stand_off / measure.STAND_OFF[geometry] - 1.0), 0.06)
    check("pressure at the nose", abs(nose / measure.STAGNATION - 1.0), 0.05)
    check("mass error", r.summary["mass_error"], 1e-12)
    check("momentum error", r.summary["momentum_error"], 1e-12)
    check("energy error", r.summary["energy_error"], 1e-10)
    clean(r)


def test_shock_before_a_cylinder():
    shock_stands("cylinder", 6e-4)


def test_shock_before_a_sphere():
    shock_stands("sphere", 2e-4)


if __name__ == "__main__":
    run(globals())
