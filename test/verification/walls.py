# SPDX-License-Identifier: BSD-3-Clause
"""What strikes a contact wall, or a rigid body that ends on a mesh line, does as it does where the surface lies within cells."""
import pathlib
from math import sqrt

from harness import check, clean, harmos, read_columns, run

DECK = pathlib.Path(__file__).resolve().parent / "decks/on_a_wall.yaml"
BALL = "material: aluminium, velocity: [0.0, -10.0]"
H = 0.0625


def plane(off):
    """A rigid plane for the wall, `off` cells above a mesh line; y of the mesh begins 3 cells below that."""
    return {"boundaries/bottom": "{type: outflow}", "materials/hard": "{eos: rigid, density: 7800.0}",
            "mesh/y": f"{{from: {-(3.0 + off) * H!r}, to: {(40.0 - off) * H!r}, cells: 43}}"}, "plane: {material: hard, shape: half-plane, point: [0.0, 0.0], normal: [0.0, 1.0], motion: fixed}"


def rebound(settings, bodies):
    """Speed at the end, over that of the start; part of the energy that contact took; cycles in which nothing touched between the first and the last touch."""
    r = harmos(DECK, {**settings, "bodies": f"{{{bodies}}}"})
    force = read_columns(r.directory / "contact.csv")["cycle"]
    apart = int(force[-1] - force[0]) + 1 - len(set(force))
    found = -r.last("ball.momentum_y") / r.first("ball.momentum_y"), r.last("contact_loss") / r.first("kinetic_energy"), apart
    print(f"  leaves with {found[0]:.3f} of its speed, contact took {found[1]:.4f} of the energy, {apart} cycles without")
    clean(r)
    return found


# Faces exposed by less than half had no row: 0.67 and 0.43 at the wall, 0.70 and 0.42 on the plane, 0.95 and 0.035 where that is first.
def test_a_disc_rebounds_from_a_wall_as_from_a_plane_within_cells():
    disc = f"ball: {{{BALL}, shape: disc, center: [0.023125, 1.01875], radius: 1.0}}"
    within, of_plane = plane(0.3)
    speed = rebound(within, f"{disc}, {of_plane}")[0]
    on_line = plane(0.0)[0]
    for name, settings, bodies in (("wall", {}, disc), ("plane on a mesh line", on_line, f"{disc}, {of_plane}"), ("plane first", on_line, f"{of_plane}, {disc}")):
        found = rebound(settings, bodies)
        check(f"{name}: speed against that from a plane within cells", abs(found[0] / speed - 1.0), 0.02)
        check(f"{name}: energy that contact took", found[1], 0.025)


# Above a wall pressed corners became chords, without a row: the square went on through it, and left with 0.07 of its speed.
def test_a_square_rebounds_on_its_corner_from_a_wall_as_from_a_plane():
    square = f"ball: {{{BALL}, shape: rectangle, center: [0.023125, {0.5 * sqrt(2.0) + 0.01875!r}], size: [1.0, 1.0], angle: 45.0}}"
    settings, of_plane = plane(0.0)
    speed = rebound(settings, f"{square}, {of_plane}")[0]
    found = rebound({}, square)
    check("speed against that from a plane", abs(found[0] / speed - 1.0), 1e-3)
    check("what it lacks", 1.0 - found[0], 0.04)


# The corner of a bar became a chord that reached the wall: felt 0.014 to 0.022 cells early, in its edge cells alone, left with 0.49 to 0.83.
def test_a_flat_bar_is_felt_by_a_wall_when_it_is_there():
    for width, middle in ((7.4, 0.0), (7.1, 0.2), (5.3, -0.37), (8.0, 0.5)):
        gap, speed = 0.3 * H, 10.0
        bar = f"ball: {{{BALL}, shape: rectangle, center: [{middle * H!r}, {8.0 * H + gap!r}], size: [{width * H!r}, {16.0 * H!r}]}}"
        r = harmos(DECK, {"bodies": f"{{{bar}}}", "run/end_time": 2.6e-3, "run/max_dt": 0.002 * H / speed})
        contact = read_columns(r.directory / "contact.csv")
        early = (gap / speed - contact["time"][0]) * speed / H
        check(f"{width} cells wide: felt early or late, cells", abs(early), 4e-3)
        check("speed that it lacks", 1.0 + r.last("ball.momentum_y") / r.first("ball.momentum_y"), 0.2)
        clean(r)


if __name__ == "__main__":
    run(globals())
