# SPDX-License-Identifier: BSD-3-Clause
"""More than 64 materials: 72 discs, each a velocity field of its own, that run into each other in a closed box."""
import pathlib
import tempfile
from math import cos, sin

from compare import ROUND_OFF, newest_checkpoint, same_history, same_state
from harness import check, clean, harmos, run

COLUMNS, ROWS, RADIUS = 9, 8, 0.045


def deck():
    """Discs a tenth apart, each on its own course."""
    lines = ["harmos:", "  mesh: {x: {from: 0.0, to: 0.9, cells: 54}, y: {from: 0.0, to: 0.8, cells: 48}}", "  materials:",
             "    soft: {eos: stiffened, density: 1000.0, sound_speed: 300.0, strength: elastic, shear_modulus: 2.0e7}", "  bodies:"]
    for n in range(COLUMNS * ROWS):
        x, y = 0.05 + 0.1 * (n % COLUMNS), 0.05 + 0.1 * (n // COLUMNS)
        lines += [f"    d{n}:", "      material: soft", "      shape: disc", f"      center: [{x:.3f}, {y:.3f}]",
                  f"      radius: {RADIUS}", f"      velocity: [{20.0 * cos(2.4 * n):.6f}, {20.0 * sin(2.4 * n):.6f}]"]
    lines += ["  run: {end_time: 2.0e-3, max_cycles: 90}", "  output:", "    xdmf: false", "    checkpoint: {at_end: true}"]
    return "\n".join(lines) + "\n"


def test_72_discs_keep_their_masses_and_ranks_agree():
    with tempfile.TemporaryDirectory() as scratch:
        path = pathlib.Path(scratch) / "discs.yaml"
        path.write_text(deck())
        one, two = harmos(path), harmos(path, ranks=2)
    names = [f"d{n}" for n in range(COLUMNS * ROWS)]
    worst = max(abs(m / one.first(f"{n}.mass") - 1.0) for n in names for m in one[f"{n}.mass"])
    check("mass of any disc", worst, 1e-12)
    exact = 1000.0 * 3.14159265358979 * RADIUS**2
    check("mass as painted", max(abs(one.first(f"{n}.mass") / exact - 1.0) for n in names), 1e-10)
    assert max(one["multipliers"]) > 50, "the discs must meet"
    met = [n for n in names if abs(one.last(f"{n}.momentum_x") - one.first(f"{n}.momentum_x")) > 1e-3 * exact * 20.0]
    print(f"  {len(met)} of {len(names)} discs have changed their course, {max(one['multipliers']):.0f} multipliers")
    assert len(met) > len(names) / 2
    check("energy error", one.summary["energy_error"], 1e-10)
    check("momentum error", one.summary["momentum_error"], 1e-12)
    same_state(newest_checkpoint(one.directory), newest_checkpoint(two.directory))
    check("history on two ranks", same_history(one, two)[0], ROUND_OFF)
    clean(one, two)


if __name__ == "__main__":
    run(globals())
