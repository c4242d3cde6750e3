# SPDX-License-Identifier: BSD-3-Clause
"""Block between frictionless rigid platens: momentum along the platens is constant at any angle and offset."""
from math import cos, radians, sin
from random import Random

from harness import check, clean, harmos, run

DECK = "sliding_block/deck.yaml"


def settings(angle, offset, cells, pressure=0.0, slide=1.0, speed=100.0, kinematics="xfem"):
    """Overrides of the deck: block of height 1 with `cells` cells over it slides `slide` along `angle` (degrees)."""
    a = radians(angle)
    t, n = (cos(a), sin(a)), (-sin(a), cos(a))
    h = 1.0 / cells
    count = round(3.2 * cells)
    ox, oy = offset[0] * h, offset[1] * h
    vec = lambda x, y: f"[{x!r}, {y!r}]"
    s = {
        "kinematics": kinematics,
        "mesh/x": f"{{from: {-count * h / 2!r}, to: {count * h / 2!r}, cells: {count}}}",
        "mesh/y": f"{{from: {-count * h / 2!r}, to: {count * h / 2!r}, cells: {count}}}",
        "bodies/block/center": vec(ox - 0.5 * slide * t[0], oy - 0.5 * slide * t[1]),
        "bodies/block/angle": float(angle),
        "bodies/block/velocity": vec(speed * t[0], speed * t[1]),
        "bodies/lower/point": vec(ox - 0.5 * n[0], oy - 0.5 * n[1]),
        "bodies/lower/normal": vec(*n),
        "bodies/upper/point": vec(ox + 0.5 * n[0], oy + 0.5 * n[1]),
        "bodies/upper/normal": vec(-n[0], -n[1]),
        "run/end_time": slide / speed,
        "output/fields/every_time": 0.0,
        "output/history/every_cycles": 1,
    }
    if pressure:
        s["bodies/block/pressure"] = pressure
    return s


def momentum_error(r, angle, speed=100.0):
    """Largest change of the block's momentum along the platens over m V."""
    a = radians(angle)
    along = [px * cos(a) + py * sin(a) for px, py in zip(r["block.momentum_x"], r["block.momentum_y"])]
    return max(abs(p - along[0]) for p in along) / (r.first("block.mass") * speed)


ANGLES = [0.0, 7.0, 15.0, 22.5, 30.0, 45.0]
OFFSETS = [(0.0, 0.0), (0.31, 0.17), (0.5, 0.77)]
# Initial pressure of the squeezed block: 1% of its longitudinal modulus.
SQUEEZE = 0.01 * 2700.0 * 5000.0**2


def sweep(cells, pressure, bound):
    worst = 0.0
    for angle in ANGLES:
        for offset in OFFSETS:
            r = harmos(DECK, settings(angle, offset, cells, pressure))
            error = momentum_error(r, angle)
            print(f"  angle {angle:4.1f} offset {offset}: {error:.2e}, unconverged {r.summary['unconverged_cycles']}")
            worst = max(worst, error)
            check("momentum ledger", r.summary["momentum_error"], 1e-12)
            check("energy ledger", r.summary["energy_error"], 1e-10)
            work = abs(r.last("contact_loss"))
            if pressure:
                check("work of the contacts as a coefficient of friction", work / (2.0 * pressure), 4.5e-4)
            else:
                check("work of the contacts over the energy of motion", work / r.first("kinetic_energy"), 1e-20)
            clean(r)
    check(f"worst momentum error, {cells} cells, pressure {pressure:.1e}", worst, bound)


# The platens' normals are exact, and no other force has a part along them.
def test_unloaded_block_keeps_its_momentum():
    sweep(8, 0.0, 1e-12)


def test_squeezed_block_keeps_its_momentum():
    sweep(8, SQUEEZE, 1e-12)


def test_any_angle_and_offset_at_any_resolution():
    random = Random(7)
    for cells, slide, times in ((8, 1.0, 3), (16, 0.5, 2), (32, 0.1, 1), (64, 0.02, 1)):
        for pressure in (0.0, SQUEEZE):
            for _ in range(times):
                angle, offset = 90.0 * random.random(), (random.random(), random.random())
                r = harmos(DECK, settings(angle, offset, cells, pressure, slide=slide))
                check(f"{cells} cells, {angle:.1f} degrees, pressure {pressure:.1e}: momentum", momentum_error(r, angle), 1e-12)
                clean(r)


# As a coefficient of friction that would take as much; the worst placements of the six angles and three offsets at 16 cells.
def test_work_of_frictionless_contacts_falls_with_the_cells():
    work = {}
    for cells in (8, 16):
        for angle, offset in ((0.0, OFFSETS[0]), (30.0, OFFSETS[1]), (45.0, OFFSETS[2])):
            r = harmos(DECK, settings(angle, offset, cells, SQUEEZE))
            work[cells] = max(work.get(cells, 0.0), abs(r.last("contact_loss")) / (2.0 * SQUEEZE))
            clean(r)
    print(f"  worst coefficient {work[8]:.1e} at 8 cells, {work[16]:.1e} at 16")
    check("work at 16 cells over that at 8", work[16] / work[8], 0.5)
    check("coefficient at 16 cells", work[16], 1e-4)


# Without restitution contact takes 0.4 to 0.5% there, of rows that close by what the next cycle's segments change.
def test_contacts_with_restitution_do_no_work_on_what_slides():
    for angle, offset in ((0.0, (0.31, 0.17)), (20.0, (0.31, 0.17)), (37.0, (0.62, 0.85))):
        r = harmos(DECK, {**settings(angle, offset, 8, SQUEEZE, slide=0.5), "interactions": "{default: sliding, restitution: 1.0}"})
        check(f"{angle} degrees: work of the contacts, over the kinetic energy", abs(r.last("contact_loss")) / r.first("kinetic_energy"), 1e-7)
        check("change of the momentum along the channel", momentum_error(r, angle), 1e-12)
        assert r.summary["unconverged_cycles"] == 0
        clean(r)


def test_single_velocity_block_sticks():
    r = harmos(DECK, settings(30.0, OFFSETS[1], 8, kinematics="single"))
    error = momentum_error(r, 30.0)
    print(f"  single: momentum error {error:.2f}")
    assert error > 0.3
    check("momentum ledger", r.summary["momentum_error"], 1e-12)
    check("energy ledger", r.summary["energy_error"], 1e-10)
    clean(r)


if __name__ == "__main__":
    run(globals())
