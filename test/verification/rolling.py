# SPDX-License-Identifier: BSD-3-Clause
"""Free rigid bodies that roll, slide and spin on rigid ones inside of cells: rigid-body mechanics has the exact answers."""
from math import atan2, cos, degrees, hypot, pi, radians, sin, sqrt, tan
from random import Random

from harness import ROOT, check, clean, harmos, read_columns, run

DECK = ROOT / "test/verification/decks/rolling.yaml"
G, R = 9.81, 0.2


def on_slope(angle, start=0.5, radius=R):
    """Ground through (0, 0.011) inclined against x, and the disc's centre `start` up the slope."""
    a = radians(angle)
    centre = (start * cos(a) - radius * sin(a), 0.011 + start * sin(a) + radius * cos(a))
    return {"bodies/ground/normal": f"[{-sin(a)!r}, {cos(a)!r}]", "bodies/disc/center": f"[{centre[0]!r}, {centre[1]!r}]"}


def motion(r, name="disc"):
    """Speed and |angular velocity| at the end: energy tells the turning, with inertia m R^2 / 2."""
    mass = r.last(f"{name}.mass")
    speed = hypot(r.last(f"{name}.momentum_x"), r.last(f"{name}.momentum_y")) / mass
    return speed, sqrt(max(4.0 * (r.last(f"{name}.kinetic_energy") / mass - 0.5 * speed**2), 0.0)) / R


def test_a_disc_rolls_down_a_slope_at_two_thirds_of_free_fall_along_it():
    for angle in (10.0, 20.0):
        r = harmos(DECK, {**on_slope(angle), "numerics/constraint/tolerance": 1e-12})
        speed, spin = motion(r)
        exact = 2.0 / 3.0 * G * sin(radians(angle)) * r.time_of_velocities()
        check(f"speed at {angle:.0f} degrees", abs(speed / exact - 1.0), 1e-9)
        check("rolls without slip", abs(spin * R / speed - 1.0), 1e-6)
        check("loss", abs(r.last("contact_loss")) / r.last("kinetic_energy"), 1e-9)
        check("energy ledger", r.summary["energy_error"], 1e-10)
        clean(r)


def test_a_disc_slips_on_a_slope_steeper_than_three_times_the_friction():
    angle, friction = radians(30.0), 0.1
    assert tan(angle) > 3.0 * friction
    r = harmos(DECK, {**on_slope(30.0), "interactions/coefficient": friction, "run/end_time": 0.4})
    speed, spin = motion(r)
    t = r.time_of_velocities()
    check("speed", abs(speed / (G * (sin(angle) - friction * cos(angle)) * t) - 1.0), 1e-9)
    check("spin", abs(spin * R / (2.0 * friction * G * cos(angle) * t) - 1.0), 1e-6)
    clean(r)


def test_a_sliding_disc_ends_rolling_at_two_thirds_of_its_speed_wherever_the_floor_lies():
    for floor in (0.0, 0.011, 0.0249):
        r = harmos(DECK, {"bodies/ground/point": f"[0.0, {floor}]", "bodies/disc/center": f"[-0.4, {floor + R}]",
                          "bodies/disc/velocity": "[1.0, 0.0]"})
        speed, spin = motion(r)
        check(f"speed, floor at {floor}", abs(speed / (2.0 / 3.0) - 1.0), 1e-9)
        check("rolls without slip", abs(spin * R / speed - 1.0), 1e-6)
        clean(r)


def test_a_disc_spins_on_a_smooth_floor_as_it_began():
    r = harmos(DECK, {"interactions": "{default: sliding}", "bodies/disc/angular_velocity": 5.0})
    speed, spin = motion(r)
    check("spin", abs(spin / 5.0 - 1.0), 1e-9)
    check("speed", speed, 1e-9)
    clean(r)


def test_a_bond_of_rigid_bodies_holds_what_it_bears_and_snaps_where_an_impulse_is_more():
    for strength, slides in ((1e-3, True), (1e9, False)):
        r = harmos(DECK, {"interactions": f"{{default: bonded, tensile_strength: {strength}, shear_strength: {strength}}}",
                          "bodies/disc": box_on_slope(0.0, -0.4, (0.4, 0.2))[:-1] + ", velocity: [1.0, 0.0]}", "gravity": "[0.0, 0.0]"})
        speed, _ = motion(r)
        if slides:
            check(f"speed that a bond of {strength} Pa takes", abs(speed - 1.0), 2e-3)
            assert r.summary["broken_bonds"] > 0
        else:
            check(f"speed that a bond of {strength} Pa leaves", speed, 1e-9)
            assert r.summary["broken_bonds"] == 0
        clean(r)


def in_ring(settings):
    """A disc of radius 0.2 that touches the inside of a fixed ring of radius 0.5."""
    bodies = "{material: hard, shape: annulus, center: [0.013, -0.027], inner_radius: 0.5, outer_radius: 0.62, motion: fixed}"
    return harmos(DECK, {"bodies/ground": bodies, "bodies/disc/center": "[0.013, -0.327]", **settings})


def distance(r):
    """Of the disc's centre from the ring's, over the time, from the velocities."""
    x, mass, out = [0.0, -0.3], r.first("disc.mass"), []
    for i, dt in enumerate(r["dt"]):
        for k, d in enumerate("xy"):
            x[k] += dt * r[f"disc.momentum_{d}"][i] / mass if i else 0.0
        out.append(hypot(*x))
    return out


# Rows across gaps that differ asked two bodies not to turn at all: in three cycles two thirds of the spin were gone.
def test_two_rigid_bodies_that_are_bonded_turn_as_one():
    spin = 10.0
    for angle in (0.0, 20.0):
        along = lambda x: (x * cos(radians(angle)), x * sin(radians(angle)))
        half = lambda x, length: (f"{{material: rock, shape: rectangle, center: {list(along(x))!r}, size: [{length!r}, 0.3], angle: {angle!r}, "
                                  f"velocity: {[-spin * along(x)[1], spin * along(x)[0]]!r}, angular_velocity: {spin!r}, motion: free}}")
        for law in ("{default: bonded}", "{default: bonded, tensile_strength: 1.0e9, shear_strength: 1.0e9}"):
            r = harmos(DECK, {"mesh": "{x: {from: -0.5, to: 0.5, cells: 40}, y: {from: -0.5, to: 0.5, cells: 40}}", "materials": "{rock: {eos: rigid, density: 1000.0}}",
                              "bodies": f"{{a: {half(-0.1485, 0.303)}, b: {half(0.1515, 0.297)}}}", "interactions": law, "gravity": "[0.0, 0.0]",
                              "run/max_dt": 1e-4, "run/max_cycles": 300})
            check("angular momentum", abs(r.last("angular_momentum") / r.first("angular_momentum") - 1.0), 1e-9)
            check("kinetic energy, part lost in 17 degrees", 1.0 - r.last("kinetic_energy") / r.first("kinetic_energy"), 1e-3)
            assert r.summary["broken_bonds"] == 0
            clean(r)


def test_a_bond_with_a_strength_that_is_made_nowhere_is_named():
    strong = "type: bonded, tensile_strength: 1.0e9"
    r = harmos(DECK, {"interactions": f"{{default: sliding, joint: {{between: disc, and: ground, {strong}}}}}", "bodies/disc": box_on_slope(0.0, -0.4, (0.4, 0.2))[:-1] + ", shift: [0.0, 0.001]}", "run/max_cycles": 3})
    assert any("interactions/joint: no bond was made" in w for w in r.summary["warnings"]), r.summary["warnings"]
    assert r.summary["bonds"] == 0
    clean(r)


def test_a_disc_runs_around_inside_a_smooth_ring():
    turn = 2.0 * pi * 0.3
    apart = []
    for dt in (0.002, 0.001):
        r = in_ring({"interactions": "{default: sliding}", "gravity": "[0.0, 0.0]", "bodies/disc/velocity": "[1.0, 0.0]",
                     "run/end_time": turn, "run/max_dt": dt})
        check("speed", abs(motion(r)[0] - 1.0), 1e-4)
        apart.append(max(abs(d - 0.3) for d in distance(r)) / 0.3)
        clean(r)
    check("distance from the ring's centre, two steps", apart[0], 1e-4)
    check("of second order in the step", apart[1] / apart[0], 0.3)


def test_a_disc_swings_in_a_ring_as_the_pendulum_that_rolls():
    """T = 2 pi sqrt(3 (b - R) / (2 g)) (1 + a^2/16): at the end of a quarter period it is at the lowest point."""
    a = 0.2
    quarter = 0.5 * pi * sqrt(1.5 * 0.3 / G) * (1.0 + a**2 / 16.0)
    x, y = 0.013 + 0.3 * sin(a), -0.027 - 0.3 * cos(a)
    r = in_ring({"bodies/disc/center": f"[{x!r}, {y!r}]", "interactions/coefficient": 0.8, "run/end_time": quarter, "run/max_dt": 5e-4})
    speed, spin = motion(r)
    check("speed at the lowest point", abs(speed / sqrt(4.0 / 3.0 * G * 0.3 * (1.0 - cos(a))) - 1.0), 1e-5)
    check("rolls without slip", abs(spin * R / speed - 1.0), 1e-6)
    check("upwards over along", abs(r.last("disc.momentum_y") / r.last("disc.momentum_x")), 1e-3)
    clean(r)


def test_a_pin_takes_its_ring_along():
    """Struck in the middle of a hole that it fills, or fills but for 1e-4: both go on with the common velocity."""
    for radius, velocity in ((0.2, (1.0, 0.0)), (0.2, (0.3, 0.7)), (0.1999, (1.0, 0.0))):
        r = harmos(DECK, {
            "gravity": "[0.0, 0.0]", "interactions": "{default: sliding}", "run/end_time": 0.3, "run/max_dt": 0.03,
            "bodies/ground": "{material: hard, shape: annulus, center: [0.0, 0.0], inner_radius: 0.2, outer_radius: 0.4, motion: free}",
            "bodies/disc": f"{{material: hard, shape: disc, center: [0.0, 0.0], radius: {radius!r}, motion: free, velocity: [{velocity[0]!r}, {velocity[1]!r}]}}"})
        ring, pin = r.last("ground.mass"), r.last("disc.mass")
        for k, axis in enumerate("xy"):
            common = velocity[k] * pin / (ring + pin)
            check(f"velocity along {axis}, radius {radius}", max(abs(r.last(f"{name}.momentum_{axis}") / mass - common) for name, mass in (("ground", ring), ("disc", pin))), 1e-6)
        check("iterations", max(r["iterations"]), 10)
        check("cycles that missed the tolerance", r.summary["unconverged_cycles"], 0)
        clean(r)


def box_on_slope(angle, start, size):
    """A free box that stands on the ground of on_slope, the middle of its lower side `start` up the slope."""
    a = radians(angle)
    middle = (start * cos(a) - 0.5 * size[1] * sin(a), 0.011 + start * sin(a) + 0.5 * size[1] * cos(a))
    return f"{{material: hard, shape: rectangle, center: {list(middle)}, size: {list(size)}, angle: {angle}, motion: free}}"


def test_a_box_slides_down_a_slope_without_turning():
    angle, friction = radians(20.0), 0.2
    r = harmos(DECK, {**on_slope(20.0), "bodies/disc": box_on_slope(20.0, 0.5, (0.4, 0.2)), "interactions/coefficient": friction})
    speed, spin = motion(r)
    check("speed", abs(speed / (G * (sin(angle) - friction * cos(angle)) * r.time_of_velocities()) - 1.0), 1e-8)
    check("spin", spin, 1e-6)
    clean(r)


def test_a_slender_box_topples_where_the_slope_is_steeper_than_width_over_height():
    """It turns about its lower edge, r from its middle, by q from the balance: d2q/dt2 = 3 g / (4 r) sin(q), by the moment of inertia 4 m r^2 / 3."""
    width, height = 0.16, 0.4
    balance, r0 = atan2(width, height), 0.5 * hypot(width, height)
    for angle in (21.6, 21.9, 25.0):
        start = radians(angle) - balance
        r = harmos(DECK, {**on_slope(angle), "bodies/disc": box_on_slope(angle, 0.3, (width, height)), "interactions/coefficient": 1.0,
                          "run/end_time": 0.3, "run/max_dt": 1e-3})
        speed = hypot(r.last("disc.momentum_x"), r.last("disc.momentum_y")) / r.last("disc.mass")
        q, rate, t, step = start, 0.0, 0.0, 1e-5
        while start > 0.0 and t < r.time_of_velocities():
            rate += step * 0.75 * G / r0 * sin(q)
            q += step * rate
            t += step
        print(f"  {angle} degrees, balance at {degrees(balance):.2f}: speed {speed:.3e}, exact {rate * r0:.3e}")
        check(f"error of the speed, slope of {angle} degrees", abs(speed - rate * r0), 1e-4 * rate * r0 + 1e-9)
        clean(r)


def test_corners_of_free_boxes_strike_with_the_impulse_of_rigid_bodies():
    """j (1/m + 1/M + l^2/I + L^2/J) = (1 + e) v, l and L the distances of the middles from the normal through the corner."""
    size, other, speed = (0.3, 0.2), (0.6, 0.4), 1.0
    random = Random(3)
    for e in (1.0, 0.5):
        for _ in range(6):
            angle, lean = random.uniform(0.0, 90.0), random.uniform(8.0, 82.0)
            a, b = radians(angle), radians(angle + lean)
            along, normal = (cos(a), sin(a)), (-sin(a), cos(a))
            corners = [(p * cos(b) - q * sin(b), p * sin(b) + q * cos(b)) for p in (-0.15, 0.15) for q in (-0.1, 0.1)]
            low = min(corners, key=lambda c: c[0] * normal[0] + c[1] * normal[1])
            at = (random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03))  # where the corner strikes
            lever = random.uniform(-0.1, 0.1)
            under = [at[k] - lever * along[k] - 0.5 * other[1] * normal[k] for k in (0, 1)]
            above = [at[k] - low[k] + 0.01 * normal[k] for k in (0, 1)]
            sides = "{from: -0.9, to: 0.9, cells: 45}"
            r = harmos(DECK, {
                "gravity": "[0.0, 0.0]", "mesh/x": sides, "mesh/y": sides, "interactions": f"{{default: sliding, restitution: {e}}}",
                "run/end_time": 0.03, "run/max_dt": 0.01,
                "bodies/ground": f"{{material: hard, shape: rectangle, center: {under}, size: {list(other)}, angle: {angle}, motion: free}}",
                "bodies/disc": f"{{material: hard, shape: rectangle, center: {above}, size: {list(size)}, angle: {angle + lean}, motion: free, velocity: {[-speed * n for n in normal]}}}"})
            mass, large = r.first("disc.mass"), r.first("ground.mass")
            l = low[0] * along[0] + low[1] * along[1]
            inverse = 1.0 / mass + 1.0 / large + 12.0 * l**2 / (mass * hypot(*size)**2) + 12.0 * lever**2 / (large * hypot(*other)**2)
            exact = (1.0 + e) * speed / inverse
            got = [r.last(f"disc.momentum_{d}") - r.first(f"disc.momentum_{d}") for d in "xy"]
            check(f"error of the impulse, leans by {lean:.0f} degrees", hypot(*(g - exact * n for g, n in zip(got, normal))) / exact, 1e-9)
            clean(r)


def test_a_disc_rolls_on_a_contact_wall():
    r = harmos(DECK, {"boundaries/bottom": "{type: contact wall, friction: 0.3}", "bodies/disc/center": "[-0.4, -0.6]",
                      "bodies/ground": "{material: hard, shape: disc, center: [0.0, 0.6], radius: 0.05, motion: fixed}",
                      "bodies/disc/velocity": "[1.0, 0.0]"})
    speed, spin = motion(r)
    check("speed", abs(speed / (2.0 / 3.0) - 1.0), 1e-9)
    check("rolls without slip", abs(spin * R / speed - 1.0), 1e-6)
    clean(r)


def test_an_elastic_disc_rolls_down_a_slope():
    """Six cells over its radius: less than one lies on the floor, so that bumps of the facets brake it by some percent."""
    soft = "{eos: stiffened, density: 1000.0, sound_speed: 60.0, strength: elastic, shear_modulus: 2.0e6}"
    settings = on_slope(20.0)
    disc = f"{{material: soft, shape: disc, center: {settings.pop('bodies/disc/center')}, radius: {R}}}"
    r = harmos(DECK, {**settings, "materials/soft": soft, "bodies/disc": disc, "interactions/coefficient": 0.5,
                      "mesh/x": "{from: -1.0, to: 1.0, cells: 60}", "mesh/y": "{from: -0.8, to: 0.7, cells: 45}"})
    speed = hypot(r.last("disc.momentum_x"), r.last("disc.momentum_y")) / r.last("disc.mass")
    check("missing part of the speed", abs(speed / (2.0 / 3.0 * G * sin(radians(20.0)) * r.last("time")) - 1.0), 0.12)
    clean(r)


def test_discs_and_boxes_fall_onto_a_heap_and_come_to_rest():
    """Statics: three discs and two boxes in a box whose walls rub; what is at rest bears the weight on its floor."""
    r = harmos(ROOT / "test/verification/decks/heap.yaml")
    fallen = r.last("external_work")
    check("energy of motion at the end, over that of the fall", r.last("kinetic_energy") / fallen, 1e-15)
    check("energy that contact took, missing from that of the fall", abs(r.last("contact_loss") / fallen - 1.0), 1e-12)
    check("overlap, in metres squared", max(r["overlap_volume"]), 1e-9)
    check("energy ledger", r.summary["energy_error"], 1e-10)
    assert r.summary["unconverged_cycles"] == 0
    rows = read_columns(r.directory / "contact.csv")
    floor = sum(y for t, b, y in zip(rows["time"], rows["b"], rows["force_y"]) if t == rows["time"][-1] and b == "contact_wall")
    check("weight on the walls", abs(floor / (r.last("mass") * G) - 1.0), 1e-8)
    clean(r)


def test_all_ranks_roll_alike():
    settings = {**on_slope(20.0), "run/end_time": 0.1}
    one = harmos(DECK, settings)
    for ranks in (2, 4):
        other = harmos(DECK, settings, ranks=ranks)
        for column in ("time", "disc.momentum_x", "disc.momentum_y", "disc.kinetic_energy", "multipliers"):
            assert one[column] == other[column], (ranks, column)
        clean(other)
    clean(one)


if __name__ == "__main__":
    run(globals())
