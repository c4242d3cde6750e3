# SPDX-License-Identifier: BSD-3-Clause
"""Contact between body-fitted blocks (kinematics lagrangian): impact, sliding, oblique impact, corners, rigid blocks.

Exact answers: elastic bars exchange their velocities; what slides without friction keeps its momentum along the
surface; what nothing holds keeps its momentum, angular momentum and energy.
"""
import tempfile
from math import cos, radians, sin, sqrt

from harness import check, clean, harmos, run

BARS = "two_bars/deck.yaml"
BLOCK = "sliding_block/deck.yaml"
QUIET = {"output/fields/every_time": 0.0}
FITTED = {"kinematics": "lagrangian", **QUIET}
RHO, C0, G, L, V = 7800.0, 4600.0, 80.0e9, 1.0, 10.0
C = sqrt(C0 * C0 + 4.0 * G / (3.0 * RHO))
HEIGHT = 0.0125
ALUMINIUM = "{eos: stiffened, density: 2700.0, sound_speed: 5000.0, strength: elastic, shear_modulus: 27.0e9}"


def rotated(angle, x, y):
    c, s = cos(radians(angle)), sin(radians(angle))
    return [c * x - s * y, s * x + c * y]


def rectangle(material, center, size, angle=0.0, velocity=(0.0, 0.0), cells=None, more=""):
    return (f"{{material: {material}, shape: rectangle, center: [{center[0]!r}, {center[1]!r}], size: [{size[0]}, {size[1]}], "
            f"angle: {angle}, velocity: [{velocity[0]!r}, {velocity[1]!r}]"
            + (f", cells: [{cells[0]}, {cells[1]}]" if cells else "") + more + "}")


def scene(bodies, end_time, materials=None, size=3.0, **more):
    """A deck of its own: blocks in the open."""
    text = ["harmos:", "  kinematics: lagrangian", "  mesh:"]
    text += [f"    {axis}: {{from: {-size}, to: {size}, cells: {int(20 * size)}}}" for axis in "xy"]
    text += ["  boundaries:"] + [f"    {side}: {{type: outflow}}" for side in ("left", "right", "bottom", "top")]
    text += ["  materials:", f"    aluminium: {ALUMINIUM}", "    platen: {eos: rigid, density: 7800.0}"]
    text += ["  bodies:"] + [f"    {name}: {body}" for name, body in bodies.items()]
    text += ["  run:", f"    end_time: {end_time!r}", "  output:", "    history: {every_cycles: 1}"]
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        file.write("\n".join(text) + "\n")
        file.flush()
        return harmos(file.name, more)


def keeps(r, scale, *columns):
    for name in columns:
        check(name, max(abs(value - r.first(name)) for value in r[name]) / scale, 1e-12)


def ledger(r):
    check("energy ledger", r.summary["energy_error"], 1e-10)
    check("mass", r.summary["mass_error"], 1e-12)
    assert r.summary["unconverged_cycles"] == 0


def test_two_bars_exchange_their_velocities():
    for gap in (0.0, 0.3):
        h = 0.0125
        r = harmos(BARS, {**FITTED, "bodies/left/center": f"[{-0.5 - gap * h}, 0.0]",
                          "run/end_time": 5.0e-4 + gap * h / V})
        scale = r["left.mass"][0] * V
        for name, sign in (("left", -1.0), ("right", 1.0)):
            velocity = r.last(f"{name}.momentum_x") / r.last(f"{name}.mass")
            check(f"exit velocity of the {name} bar", abs(velocity - sign * V / 2) / (V / 2), 0.03)
        plateau = RHO * C * V / 2
        start = gap * h / V
        # on the right bar: what it gained of momentum by the middle of the contact
        row = next(i for i, t in enumerate(r["time"]) if t > start + L / C)
        gained = r["right.momentum_x"][row] - r["right.momentum_x"][0]
        check("plateau stress", abs(gained / (HEIGHT * (r["time"][row] - start)) - plateau) / plateau, 0.01)
        keeps(r, scale, "momentum_x")
        ledger(r)
        clean(r)


def test_block_slides_on_rigid_blocks_at_any_angle():
    """Thrown at V/10 onto the lower platen while it slides: the platens take no momentum along their faces.

    Not to round-off: the normals are fitted to both faces, and that of the block is bent by its waves.
    """
    for angle in (0.0, 15.0, 30.0, 45.0):
        t, n = rotated(angle, 1.0, 0.0), rotated(angle, 0.0, 1.0)
        at = rotated(angle, -0.45, 0.0)
        v = [100.0 * t[i] - 10.0 * n[i] for i in (0, 1)]
        platen = {side: rectangle("platen", rotated(angle, 0.0, y), [2.0, 0.25], angle, cells=[33, 4])
                  for side, y in (("lower", -0.525), ("upper", 0.525))}
        r = scene({"block": rectangle("aluminium", at, [0.8, 0.8], angle, v, [16, 16]), **platen}, 4.0e-3)
        scale = r.first("block.mass") * 100.0
        along = [p * t[0] + q * t[1] for p, q in zip(r["block.momentum_x"], r["block.momentum_y"])]
        across = [p * n[0] + q * n[1] for p, q in zip(r["block.momentum_x"], r["block.momentum_y"])]
        print(f"  {angle} degrees: momentum across {across[0] / scale:.3f} to {across[-1] / scale:.3f}, cycles {r.summary['cycles']}")
        check("momentum along the platens", max(abs(p - along[0]) for p in along) / scale, 1e-5)
        assert max(across) > 0.05 * scale, "it never bounced"
        ledger(r)
        clean(r)


def test_oblique_impact_of_rotated_blocks_conserves():
    """Face to face with an offset, and a corner that hits a face: nothing from outside."""
    for name, angle_b, distance, offset in (("offset faces", 20.0, 1.001, 0.3), ("corner on face", 65.0, 1.2081, 0.1)):
        n = rotated(20.0, 1.0, 0.0)
        s = rotated(20.0, 0.0, 1.0)
        center = [-0.5 * distance * n[i] for i in (0, 1)], [0.5 * distance * n[i] + offset * s[i] for i in (0, 1)]
        v = [60.0 * n[i] + 15.0 * s[i] for i in (0, 1)]
        r = scene({"a": rectangle("aluminium", center[0], [1.0, 1.0], 20.0, v, [16, 16]),
                   "b": rectangle("aluminium", center[1], [1.0, 1.0], angle_b, [-x for x in v], [13, 13])}, 1.5e-3)
        scale = r.first("a.mass") * 60.0
        exchanged = sqrt(sum((r.last(f"a.momentum_{d}") - r.first(f"a.momentum_{d}")) ** 2 for d in "xy"))
        print(f"  {name}: exchanged {exchanged / scale:.3f} of the momentum, contact loss "
              f"{r.last('contact_loss') / r.first('kinetic_energy'):.4f} of the energy")
        assert exchanged > 0.2 * scale
        keeps(r, scale, "momentum_x", "momentum_y")
        # A row with a gap presses along the fitted normal, at the ends of the segment's own: a torque of gap times angle.
        turn = max(abs(value - r.first("angular_momentum")) for value in r["angular_momentum"])
        check("angular momentum", turn / scale, 1e-5)
        ledger(r)
        clean(r)


def test_free_rigid_block_hit_off_its_centre_turns_and_keeps_its_shape():
    r = scene({"a": rectangle("aluminium", [-0.551, 0.3], [1.0, 0.3], 0.0, [80.0, 0.0], [20, 6]),
               "rigid": rectangle("platen", [0.0, 0.0], [0.1, 1.0], 0.0, cells=[3, 25], more=", motion: free")}, 4.0e-3)
    scale = r.first("a.mass") * 80.0
    keeps(r, scale, "momentum_x", "momentum_y")
    turn = max(abs(value - r.first("angular_momentum")) for value in r["angular_momentum"])
    check("angular momentum", turn / scale, 1e-5)
    assert r.last("rigid.momentum_x") > 0.2 * scale
    turned = r.last("rigid.x_max") - r.last("rigid.x_min")
    print(f"  it turned: width {turned:.3f} of 0.1 upright")
    assert turned > 0.2
    check("area of the rigid block", abs(r.last("rigid.volume") / r.first("rigid.volume") - 1.0), 1e-12)
    ledger(r)
    clean(r)


def test_block_bounces_in_a_box_of_four_contact_walls():
    block = rectangle("aluminium", [0.05, -0.1], [0.6, 0.3], 0.0, [30.0, 20.0], [8, 4])
    sides = {f"boundaries/{side}": "{type: contact wall}" for side in ("left", "right", "bottom", "top")}
    r = scene({"block": block}, 0.06, size=1.0, **sides)
    for axis in "xy":
        check(f"beyond the walls along {axis}, of a cell", max(max(r[f"block.{axis}_max"]) - 1.0,
                                                               -1.0 - min(r[f"block.{axis}_min"])) / 0.075, 0.05)
        assert min(r[f"block.momentum_{axis}"]) < 0.0  # it has turned
    ledger(r)
    clean(r)


if __name__ == "__main__":
    run(globals())
