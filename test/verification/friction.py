# SPDX-License-Identifier: BSD-3-Clause
"""Friction against Coulomb's law: a block on an incline slides with g (sin a - mu cos a) or stays; a wall that rubs."""
from math import cos, radians, sin, sqrt, tan

from harness import ROOT, check, clean, harmos, read_columns, run
from lagrangian_contact import rectangle, scene

DECK, DECKS = "incline/deck.yaml", ROOT / "test/verification/decks"
G, QUIET = 10.0, {"output/fields/every_time": 0.0, "output/fields/at_end": False}


def incline(angle, coefficient, cells=10, end=0.6, rigid=False, offset=(0.0, 0.0), **more):
    """The deck's block on a plane inclined by `angle` degrees, `cells` cells over the block; offset of both [m]."""
    a = radians(angle)
    down, normal = (cos(a), -sin(a)), (sin(a), cos(a))
    vec = lambda x, y: f"[{x!r}, {y!r}]"
    settings = {
        "mesh/x/cells": round(3.2 * cells), "mesh/y/cells": round(2.4 * cells),
        "bodies/block/center": vec(offset[0] + 0.5 * normal[0], offset[1] + 0.5 * normal[1]), "bodies/block/angle": -float(angle),
        "bodies/plane/point": vec(*offset), "bodies/plane/normal": vec(*normal), "interactions/coefficient": coefficient, "run/end_time": end, **QUIET, **more,
    }
    if rigid:
        settings.update({"bodies/block/material": "rock", "bodies/block/motion": "free"})
    r = harmos(DECK, settings)
    speed = [(px * down[0] + py * down[1]) / m
             for px, py, m in zip(r["block.momentum_x"], r["block.momentum_y"], r["block.mass"])]
    return r, speed


def slope_of(r, speed, angle, coefficient):
    """Mean acceleration down the plane. As long as it slides, friction is mu times the normal force, cycle by cycle; the
    momentum that a bouncing block still has across the plane tells by how much that force's mean is off m g cos a."""
    a = radians(angle)
    rise = (r.last("block.momentum_x") * sin(a) + r.last("block.momentum_y") * cos(a)) / r.last("block.mass")
    return (speed[-1] - speed[0] + coefficient * rise) / r.time_of_velocities()


def slide(angle, coefficient, bound, **more):
    a = radians(angle)
    exact = G * (sin(a) - coefficient * cos(a))
    r, speed = incline(angle, coefficient, **more)
    found = slope_of(r, speed, angle, coefficient)
    print(f"  {angle} degrees, mu {coefficient}, {more}: {found:.4f} m/s^2, exact {exact:.4f}; "
          f"unconverged {r.summary['unconverged_cycles']}, most iterations {max(r['iterations']):.0f}")
    check("acceleration, of g", abs(found - exact) / G, bound)
    check("unconverged cycles", r.summary["unconverged_cycles"], 0.5)
    check("momentum ledger", r.summary["momentum_error"], 1e-12)
    check("energy ledger", r.summary["energy_error"], 1e-9)
    assert r.last("contact_loss") > 0.0
    clean(r)


def test_a_block_above_the_friction_angle_slides_with_the_exact_acceleration():
    slide(20.0, 0.2, 5e-3)
    slide(30.0, 0.3, 5e-3)


def test_a_rigid_block_does_the_same():
    slide(20.0, 0.2, 1e-3, rigid=True)


def way(r, speed):
    return sum(v * dt for v, dt in zip(speed, r["dt"]))


def fitted_way(angle, coefficient, cells, end):
    """Of the same block with a mesh of its own on a level plane, gravity inclined instead: neither cut cells nor a remap."""
    a = radians(angle)
    r = scene({"block": rectangle("rubber", (0.0, 0.5), (1.0, 1.0), cells=(cells, cells)),
               "plane": rectangle("platen", (0.0, -0.3), (6.0, 0.6), cells=(44, 3), more=", motion: fixed")}, end,
              gravity=f"[{G * sin(a)!r}, {-G * cos(a)!r}]", **{
                  "materials/rubber": "{eos: stiffened, density: 1000.0, sound_speed: 50.0, strength: elastic, shear_modulus: 1.0e6}",
                  "interactions": f"{{default: friction, coefficient: {coefficient}}}", **QUIET})
    found = way(r, [p / m for p, m in zip(r["block.momentum_x"], r["block.mass"])])
    clean(r)
    return found


# At 1.2 times the friction that holds, half the base lifts and a toe of one or two cells bears the block, which slides while it
# swings and then rests. While a toe beside void was strained as its whole cell the first place's went to a quarter less than the
# density of its pressure, and the block slid on: 0.134, 0.023 and 0.034 m by then, with last digits up to 0.9 m in 1.5 s.
def test_a_block_that_bears_on_its_toe_comes_to_rest_where_a_body_fitted_one_does():
    ways = [fitted_way(30.0, 0.7, cells, 0.75) for cells in (10, 20)]
    print("  body-fitted, 10 and 20 cells:", ", ".join(f"{w:.4f}" for w in ways))
    for offset in ((0.03, 0.02), (0.05, 0.07), (0.08, 0.01)):
        r, speed = incline(30.0, 0.7, end=0.75, offset=offset)
        print(f"  {offset}: {way(r, speed):.4f} m")
        check("way over the larger one of body-fitted blocks", way(r, speed) / max(ways), 1.2)
        check("unconverged cycles", r.summary["unconverged_cycles"], 0.5)
        clean(r)


def test_all_solvers_give_the_same_slide():
    # Short: a block that hops on its corners makes much of small differences, tenfold in some 2 ms from 1e-13 on.
    tight = {"numerics/constraint/tolerance": 1e-8, "numerics/constraint/max_iterations": 40000}
    first, newton = incline(20.0, 0.2, end=0.013, **tight)
    check("most iterations of projected Newton steps", max(first["iterations"]), 50)
    for solver in ("conjugate gradients", "row sums"):
        other, speeds = incline(20.0, 0.2, end=0.013, **{"numerics/constraint/solver": solver}, **tight)
        print(f"  most iterations of {solver}: {max(other['iterations']):.0f}")
        check(f"{solver}: difference of the final speed, of one", abs(newton[-1] - speeds[-1]) / abs(speeds[-1]), 1e-4)
        clean(other)
    clean(first)


def test_penalty_and_nitsche_rub_too():
    for constraint in ("{method: penalty, penalty: 0.3}", "{method: nitsche}"):
        slide(20.0, 0.2, 1e-2, end=0.3, **{"numerics/constraint": constraint})


def test_a_disc_rubs_its_way_through_a_plate_in_few_iterations():
    # Few multipliers, curved interfaces: where friction's bounds only follow, some of these cycles never end.
    for friction, cycles in ((0.2, 40), (0.25, 40), (0.5, 40), (1.0, 40)):
        r = harmos("disc_through_plate/deck.yaml", {"interactions": f"{{default: friction, coefficient: {friction!r}}}", "run/max_cycles": cycles})
        check(f"iterations with coefficient {friction}", max(r["iterations"]), 50)
        check("cycles that missed the tolerance", r.summary["unconverged_cycles"], 0)
        clean(r)


def test_a_bond_of_two_bars_holds_below_its_strength_and_breaks_above():
    rho, c, g, speed = 7800.0, 4600.0, 80.0e9, 10.0
    tension = 0.5 * rho * sqrt(c * c + 4.0 * g / (3.0 * rho)) * speed  # bars drawn apart: rho c V/2
    for strength, broken in ((1.1 * tension, 0), (0.9 * tension, 1)):
        r = harmos("two_bars/deck.yaml", {
            "bodies/left/velocity": f"[{-speed / 2}, 0.0]", "bodies/right/velocity": f"[{speed / 2}, 0.0]", "mesh/x/cells": 100,
            "mesh/y": "{from: 0.0, to: 0.025, cells: 1}", "interactions/default": "bonded",
            "interactions/tensile_strength": strength, "run/end_time": 2.0e-4, **QUIET})
        assert r.summary["broken_bonds"] == broken
        late = [px for t, px in zip(r["time"], r["right.momentum_x"]) if t > 1.0e-4]
        change = abs(late[-1] - late[0]) / r.first("right.momentum_x")
        print(f"  strength {strength / tension:.1f} of the tension: momentum of a bar changes by {change:.2e} in the second half")
        assert change > 0.2 if broken == 0 else change < 1e-12
        clean(r)


def pulled(angle, shear, offset=0.0):
    """Traction over strength where a joint breaks whose load grows slowly; exact is one. Waves of both grips make steps of 0.04.

    The load is what the displacement of the grips gives without waves: (2 G d / length) of a bar without lateral strain, G d / height
    of a sheared layer (which is without load at its ends, over about its height). By offsets of 1e-9 cells a sheared layer at 30 degrees
    breaks at 0.935 to 0.984, at 0 degrees by eight offsets of up to half a cell at 0.950 to 0.999: the median of a few says more than one.
    """
    rho, g, strength, step = 1000.0, 1.5e9, 3.0e6, 0.02
    half, width = (4.0, 20.0) if shear else (12.0, 8.0)
    stiffness, wave = (g, sqrt(g / rho)) if shear else (2.0 * g, sqrt(2.0 * g / rho))
    speed = step * strength / (rho * wave)
    c, s = cos(radians(angle)), sin(radians(angle))

    def at(x, y):
        return f"[{0.31 + offset + x * c - y * s}, {0.17 + x * s + y * c}]"

    ahead = (-s, c) if shear else (c, s)
    settings = {"run/end_time": 1.2 * strength * half / (stiffness * speed)}
    settings[f"interactions/glue/{'shear' if shear else 'tensile'}_strength"] = strength
    for name, side in ("a", -1.0), ("b", 1.0):
        settings |= {f"bodies/{name}/center": at(side * half / 2.0, 0.0), f"bodies/{name}/size": f"[{half}, {width}]", f"bodies/{name}/angle": angle}
    for name, side in ("left", -1.0), ("right", 1.0):
        settings |= {f"bodies/{name}/center": at(side * (half + 1.5), 0.0), f"bodies/{name}/size": f"[3.0, {width + 3.0}]",
                     f"bodies/{name}/angle": angle, f"bodies/{name}/velocity": f"[{side * speed * ahead[0]}, {side * speed * ahead[1]}]"}
    r = harmos(DECKS / "pulled_bar.yaml", settings)
    rows = read_columns(r.directory / "contact.csv")
    joint = [(abs(fx * ahead[0] + fy * ahead[1]), t) for a, b, fx, fy, t in zip(
        rows["a"], rows["b"], rows["force_x"], rows["force_y"], rows["time"]) if (a, b) == ("a", "b")]
    assert r.summary["broken_bonds"] > 0.5 * width
    found = stiffness * speed * max(joint)[1] / half / strength
    print(f"  {angle} degrees, {'shear' if shear else 'tension'}: breaks at {found:.3f} of the strength, "
          f"{r.summary['broken_bonds']} bonds")
    clean(r)
    return found


def test_a_joint_breaks_at_its_strength_whatever_its_angle_to_the_mesh():
    for angle in (0.0, 20.0, 45.0):
        check("traction over tensile strength, from one", abs(pulled(angle, False) - 1.0), 0.07)
    for angle in (0.0, 30.0):
        found = sorted(pulled(angle, True, offset) for offset in ((0.0, 0.05, 0.13) if angle == 0.0 else (0.0, 1e-9, 2e-9)))
        check("traction over shear strength, from one", abs(found[len(found) // 2] - 1.0), 0.07)


def parted(part, angle, shift, courant):
    """Bonds that break, and bonds that carried, where two blocks (Poisson's ratio 0) bonded with a strength of `part` rho c V
    start to move apart with V each: the joint bears rho c V at once, all along it, until the waves are back at 2 L / c."""
    rho, wave, length, width = 1000.0, sqrt(3.0e6), 12.0, 8.0
    c, s = cos(radians(angle)), sin(radians(angle))
    strength, side = part * rho * wave, "{from: -23.0, to: 23.0, cells: 46}"

    def at(x):
        return f"[{shift[0] + x * c}, {shift[1] + x * s}]"

    settings = {"run/end_time": 1.5 * length / wave, "numerics": f"{{courant: {courant}}}", "mesh/x": side, "mesh/y": side,
                "interactions/glue": f"{{between: a, and: b, type: bonded, tensile_strength: {strength}, shear_strength: {strength}}}"}
    for name, to in ("a", -1.0), ("b", 1.0):
        settings |= {f"bodies/{name}/center": at(to * length / 2.0), f"bodies/{name}/size": f"[{length}, {width}]",
                     f"bodies/{name}/angle": angle, f"bodies/{name}/velocity": f"[{to * c}, {to * s}]"}
    for name, to in ("left", -1.0), ("right", 1.0):  # out of the way
        settings |= {f"bodies/{name}/center": at(to * 19.9), f"bodies/{name}/angle": angle, f"bodies/{name}/velocity": "[0.0, 0.0]"}
    r = harmos(DECKS / "pulled_bar.yaml", settings)
    clean(r)
    return r.summary["broken_bonds"]


def test_a_joint_drawn_apart_at_once_bears_the_impedance_times_the_velocity():
    for angle, shift in (0.0, (0.0, 0.0)), (0.0, (0.31, 0.17)), (20.0, (0.31, 0.17)):
        for courant in 0.9, 0.5, 0.1:
            broken = {part: parted(part, angle, shift, courant) for part in (0.95, 1.4)}
            print(f"  {angle} degrees, shift {shift}, Courant number {courant}: bonds broken of {broken}")
            assert broken[0.95] == 8 and broken[1.4] == 0, broken


def test_a_block_below_the_friction_angle_stays():
    angle, coefficient = 20.0, 0.6
    assert coefficient > tan(radians(angle))
    r, speed = incline(angle, coefficient)
    free = G * sin(radians(angle)) * 0.6
    way = sum(s * dt for s, dt in zip(speed, r["dt"]))
    check("mean speed down the plane, of what it would have without friction", abs(way / 0.6) / free, 2e-2)
    print(f"  way {way:.2e} m, without friction {0.5 * free * 0.6:.2e} m")
    clean(r)


def test_a_wall_rubs_a_block_in_both_kinematics():
    deck = ROOT / "test/verification/two_blocks.yaml"
    block = {"bodies/lower/velocity": "[10.0, 0.0]", "bodies/lower/center": "[0.5, 0.25]", "gravity": "[0.0, -1000.0]",
             "bodies/upper/center": "[1.5, 0.85]", "bodies/upper/size": "[0.2, 0.2]", "bodies/upper/velocity": "[0.0, 0.0]",
             "run/end_time": 4.0e-3, **QUIET}
    for kinematics in ("lagrangian", "xfem"):
        r = harmos(deck, {**block, "kinematics": kinematics, "boundaries/bottom": "{type: contact wall, friction: 0.5}"})
        lost = 10.0 - r.last("lower.momentum_x") / r.last("lower.mass")
        borne = 1000.0 * r.time_of_velocities() + r.last("lower.momentum_y") / r.last("lower.mass")
        # Body-fitted 4e-7 to 3e-6 while the normals there leaned with the block's lower side.
        check(f"{kinematics}: speed lost against mu times the impulse of the wall", abs(lost / (0.5 * borne) - 1.0), 1e-12)
        assert lost > 1.0
        clean(r)



def film_at_rest(width, cycles=500):
    """Two blocks with a film between them, 1e-2 rho c^2 in all three, everything rubs: pressure at the interfaces over that at the start."""
    body = lambda left, right: (f"{{material: metal, shape: rectangle, center: [{0.5 * (left + right)!r}, 2.0], "
                                f"size: [{right - left!r}, 4.0], pressure: 0.01}}")
    r = harmos(DECKS / "sliver.yaml", {
        "bodies/left": body(0.0, 8.3), "bodies/film": body(8.3, 8.3 + width), "bodies/right": body(8.3 + width, 16.0),
        "interactions": "{default: friction, coefficient: 0.2}", "run/max_cycles": cycles,
        "output/history/every_cycles": cycles, **QUIET})
    contact = read_columns(r.directory / "contact.csv")
    clean(r)
    return abs(contact["force_x"][-1]) / contact["area"][-1] / 0.01


# Rows that rub give way by a millionth (decision 0010). Of a film's own row sums that takes 3% of the pressure here.
def test_a_film_between_blocks_at_rest_keeps_its_pressure():
    for width in (0.1, 1e-3):
        check(f"film of {width} cells: part of the pressure that is lost in 500 cycles", abs(film_at_rest(width) - 1.0), 1e-4)


if __name__ == "__main__":
    run(globals())
