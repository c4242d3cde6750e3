# SPDX-License-Identifier: BSD-3-Clause
"""A stream at Mach 3 against rigid bodies in the cells: where the shock stands, what the nose bears, what
the layer between keeps."""
import sys

from harness import EXAMPLE, check, clean, harmos, run

sys.path.insert(0, str(EXAMPLE / "bow_shock"))
import measure  # noqa: E402


def shock_stands(deck, settings, largest):
    r = harmos(f"bow_shock/{deck}.yaml", settings)
    found = measure.measure(r.directory)
    print(f"  {deck}: stand-off {found.stand_off:.3f} of {measure.STAND_OFF[found.geometry]:.3f}, nose {found.nose:.2f} of "
          f"{measure.STAGNATION:.2f}, total pressure {found.total_pressure:.4f}, enthalpy {found.enthalpy:.4f}")
    check("stand-off beside Billig's", abs(found.stand_off / measure.STAND_OFF[found.geometry] - 1.0), 0.06)
    check("pressure at the nose", abs(found.nose / measure.STAGNATION - 1.0), largest)
    check("total pressure behind the shock", abs(found.total_pressure - 1.0), largest)
    check("total enthalpy behind the shock", abs(found.enthalpy - 1.0), 0.01)
    check("mass error", r.summary["mass_error"], 1e-12)
    check("momentum error", r.summary["momentum_error"], 1e-12)
    check("energy error", r.summary["energy_error"], 1e-10)
    clean(r)


def test_shock_before_a_cylinder():
    shock_stands("cylinder", {"run/end_time": 6e-4}, 0.035)


def test_shock_before_a_sphere():
    """The front of the sphere alone, 32 cells over its radius."""
    shock_stands("sphere", {"run/end_time": 2e-4, "mesh/x/to": 0.05, "mesh/x/cells": 80, "mesh/y/from": -0.03, "mesh/y/to": 0.02,
                            "mesh/y/cells": 80, "bodies/air/center": [0.025, -0.005], "bodies/air/size": [0.05, 0.05]}, 0.035)


if __name__ == "__main__":
    run(globals())
