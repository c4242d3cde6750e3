# SPDX-License-Identifier: BSD-3-Clause
"""Corners of squares on faces of blocks, one or the other rigid or none, and on walls: nothing is felt through void, and what acts is along the face's normal."""
from math import cos, hypot, radians, sin, sqrt
from random import Random

from harness import ROOT, check, clean, harmos, read_columns, run
from lagrangian_contact import rectangle
from lagrangian_contact import scene as fitted_scene

H = 0.01
SPEED = 20.0  # at which corners come down [m/s]


class Scene:
    """A steel block whose upper side is inclined by a random angle, at a random place of the mesh, and a square on its corner above it."""

    def __init__(self, random, lean):
        self.angle, self.lean = random.uniform(0.0, 90.0), random.uniform(*lean)
        a = radians(self.angle)
        self.along, self.normal = (cos(a), sin(a)), (-sin(a), cos(a))
        self.middle = tuple(0.3 + random.random() * H for _ in range(2))

    def run(self, along, gap, velocity, end_time, rigid=None, interactions="{default: sliding}"):
        """`along`, `gap`: of the corner in cells; `velocity`: of the square, along the face and up; `rigid`: a body."""
        u, n, half = self.along, self.normal, 0.05
        t = radians(self.angle + self.lean)
        corners = [(p * cos(t) - q * sin(t), p * sin(t) + q * cos(t)) for p in (-half, half) for q in (-half, half)]
        low = min(corners, key=lambda c: c[0] * n[0] + c[1] * n[1])
        block = [self.middle[k] - half * n[k] for k in (0, 1)]
        square = [self.middle[k] + H * (along * u[k] + gap * n[k]) - low[k] for k in (0, 1)]
        v = [velocity[0] * u[k] + velocity[1] * n[k] for k in (0, 1)]
        side, outflow = "{from: 0.0, to: 0.6, cells: 60}", "{type: outflow}"
        return harmos(ROOT / "test/verification/decks/gaps.yaml", {
            "mesh": f"{{x: {side}, y: {side}}}", "boundaries/bottom": outflow, "boundaries/top": outflow, "output/fields/every_time": 0.0, "run/end_time": end_time,
            "materials/hard": "{eos: rigid, density: 7800.0}", "interactions": interactions,
            "bodies": f"{{one: {{{self.material('one', rigid)}, shape: rectangle, center: {block!r}, size: [0.2, 0.1], angle: {self.angle!r}}}, "
                      f"two: {{{self.material('two', rigid)}, shape: rectangle, center: {square!r}, size: [0.1, 0.1], angle: {self.angle + self.lean!r}, velocity: {v!r}}}}}"})

    @staticmethod
    def material(name, rigid):
        return "material: steel" if name != rigid else "material: hard, motion: " + ("fixed" if name == "one" else "free")


# With the means of face and edge for normals 10 of 60 felt 2e-5 to 5e-4 of the momentum, for a cycle each.
def test_a_corner_that_slides_along_a_face_feels_nothing():
    for rigid, gap, squares in ((None, 0.003, 16), (None, 0.001, 16), ("one", 0.001, 8), ("two", 0.001, 8)):
        random, felt = Random(12), 0
        for _ in range(squares):
            r = Scene(random, (5.0, 85.0)).run(random.uniform(-3.0, 3.0), gap, (200.0, 0.0), 1.2e-4, rigid)
            felt += len(read_columns(r.directory / "contact.csv")["time"]) > 0
            clean(r)
        check(f"{gap} cells above it, squares of {squares} that feel the block, rigid: {rigid}", felt, 0)


def first_felt(r):
    c = read_columns(r.directory / "contact.csv")
    return min(t for t, x, y in zip(c["time"], c["force_x"], c["force_y"]) if hypot(x, y) > 0.0)


def struck(scene, along, slide, rigid=None, interactions="{default: sliding}"):
    """Impulse along the face over that along its normal, and void left when the corner is first felt. [cells]"""
    gap = 0.3
    r = scene.run(along, gap, (slide, -SPEED), gap * H / SPEED + 3e-4, rigid, interactions)
    tangent, normal = (sum((r[f"two.momentum_{x}"][-1] - r[f"two.momentum_{x}"][0]) * d[k] for k, x in enumerate("xy")) for d in (scene.along, scene.normal))
    first = first_felt(r)
    check("momentum", r.summary["momentum_error"], 1e-12)
    clean(r)
    return tangent / normal, gap - SPEED * first / H


# Places where a tip that comes into the cell of the face was drawn as a film along the cell's side, up to the face: felt 0.18 and 0.06 cells early.
def test_a_tip_that_crosses_a_side_of_its_cell_is_felt_in_time():
    for seed, number in ((6, 3), (504, 7)):
        random = Random(seed)
        scenes = [(Scene(random, (5.0, 85.0)), random.uniform(-1.0, 1.0)) for _ in range(number + 1)]
        _, void = struck(*scenes[number], 100.0)
        check("void when it is first felt, cells", void, 0.005)


# Rows of bonded pairs are those of their segments; what no bond holds had these too, and 3 of 10 corners that slid by felt the block.
def test_what_was_apart_at_the_start_slides_whatever_the_strength_of_its_bond():
    random, bonded = Random(8), "{default: bonded, tensile_strength: 1.0e9, shear_strength: 1.0e9}"
    for _ in range(3):
        scene, along = Scene(random, (5.0, 85.0)), random.uniform(-1.0, 1.0)
        slides, holds = struck(scene, along, 100.0), struck(scene, along, 100.0, None, bonded)
        check("difference of along over normal impulse from that of a sliding pair", abs(slides[0] - holds[0]), 0.0)
        check("of the void when first felt", abs(slides[1] - holds[1]), 0.0)


# On meshes of half and a quarter of the cells 1e-3 to 4e-3 along the face. With rows in the middle of facets and the means of face
# and edge for normals a tenth (root mean square), and up to a quarter of a cell late; with rows that throw light nodes out of their
# way 0.017.
def test_a_corner_strikes_along_the_normal_of_the_face():
    random = Random(5)
    for slide in (0.0, 100.0):
        found = [struck(Scene(random, (5.0, 85.0)), random.uniform(-1.0, 1.0), slide) for _ in range(16)]
        ratio, void = sorted(abs(f[0]) for f in found), [f[1] for f in found]
        print(f"  along over normal impulse, sliding at {slide} m/s: median {ratio[8]:.1e}, root mean square {sqrt(sum(x * x for x in ratio) / 16):.1e}, largest {ratio[-1]:.1e}")
        check("median", ratio[8], 0.01)
        check("root mean square", sqrt(sum(x * x for x in ratio) / 16), 0.012)
        check("felt through, cells", max(void), 1e-3)
        check("late, cells", -min(void), 0.1)


# The energy of a rigid corner in an elastic face does not depend on where along the face it is. With the normals of its edges, which
# are exact, the square was pushed along the face by the slope of the shallower edge: 0.59 of the impulse, 0.25 in the median.
def test_a_rigid_corner_strikes_along_the_normal_of_the_face_and_a_rigid_face_bears_a_corner():
    for rigid, largest in (("two", 5e-3), ("one", 1e-12)):
        random = Random(5)
        found = [struck(Scene(random, (5.0, 85.0)), random.uniform(-1.0, 1.0), 0.0, rigid) for _ in range(16)]
        check(f"rigid: {rigid}: along over normal impulse, largest", max(abs(f[0]) for f in found), largest)
        check("felt through, cells", max(f[1] for f in found), 1e-3)
        check("late, cells", -min(f[1] for f in found), 5e-3)


def test_corners_that_rub_bear_the_coefficient_of_friction():
    for rigid in ("two", "one"):
        random = Random(5)
        for _ in range(6):
            ratio, _ = struck(Scene(random, (5.0, 85.0)), random.uniform(-1.0, 1.0), 100.0, rigid, "{default: friction, coefficient: 0.3}")
            check(f"rigid: {rigid}: along over normal impulse, less -0.3", abs(ratio + 0.3), 5e-3)


def bounced(r, normal=(0.0, 1.0)):
    """Impulse on the square along the face's normal, over m V, and the kinetic energy at the end, over that at the start."""
    impulse = sum((r[f"two.momentum_{x}"][-1] - r[f"two.momentum_{x}"][0]) * n for x, n in zip("xy", normal))
    found = impulse / (r.first("two.mass") * SPEED), r.last("kinetic_energy") / r.first("kinetic_energy")
    clean(r)
    return found


def body_fitted(lean, gap, end_time, rigid):
    """The same with a mesh of 20 x 20 cells in the square, which its corner and its sides follow."""
    t, half = radians(lean), 0.05
    corners = [(p * cos(t) - q * sin(t), p * sin(t) + q * cos(t)) for p in (-half, half) for q in (-half, half)]
    low = min(corners, key=lambda c: c[1])
    fixed = ", motion: fixed" if rigid == "one" else ""
    return bounced(fitted_scene(
        {"one": rectangle("platen" if fixed else "aluminium", (0.0, -half), (0.2, 0.1), cells=(40, 20), more=fixed),
         "two": rectangle("aluminium", (-low[0], gap * H - low[1]), (0.1, 0.1), lean, (0.0, -SPEED), (20, 20))}, end_time, size=0.3,
        **{"materials/aluminium": "{eos: stiffened, density: 7800.0, sound_speed: 4600.0, strength: elastic, shear_modulus: 80.0e9}", "output/fields/every_time": 0.0}))


# Until the light nodes of tips went with the body behind them: impulse 0.92 and 0.96 in the mean and 0.69 and 0.85 at least of the body-fitted
# one, energy 0.86 and 0.84 in the mean and 0.63 and 0.55 at least (24 squares): hourglass viscosity made heat of it.
def test_a_corner_bounces_as_a_body_fitted_one_does():
    for rigid, least_impulse, least_energy in ((None, 0.91, 0.83), ("one", 0.95, 0.85)):
        ratios = []
        for seed in range(12):
            random, gap = Random(seed), 0.3
            scene, along, end_time = Scene(random, (5.0, 85.0)), random.uniform(-1.0, 1.0), gap * H / SPEED + 3e-4
            found = bounced(scene.run(along, gap, (0.0, -SPEED), end_time, rigid), scene.normal)
            ratios.append([a / b for a, b in zip(found, body_fitted(scene.lean, gap, end_time, rigid))])
        impulse, energy = ([ratio[k] for ratio in ratios] for k in (0, 1))
        print(f"  rigid: {rigid}: impulse over the body-fitted one's {min(impulse):.3f} to {max(impulse):.3f}, mean {sum(impulse) / 12:.3f}; "
              f"kinetic energy that is left {min(energy):.3f} to {max(energy):.3f}, mean {sum(energy) / 12:.3f}")
        check("what the least impulse lacks", 1.0 - min(impulse), 1.0 - least_impulse)
        check("beyond the body-fitted one", max(impulse) - 1.0, 0.1)
        check("what the least energy lacks", 1.0 - min(energy), 1.0 - least_energy)


# With rows in the middle of facets up to 0.38 cells late.
def test_a_contact_wall_bears_a_corner():
    random, gap, half = Random(5), 0.3, 0.05
    for _ in range(16):
        lean, along = random.uniform(5.0, 85.0), random.uniform(0.28, 0.32)
        t = radians(lean)
        low = -half * (sin(t) + cos(t))
        side = "{from: 0.0, to: 0.6, cells: 60}"
        r = harmos(ROOT / "test/verification/decks/gaps.yaml", {
            "mesh": f"{{x: {side}, y: {side}}}", "boundaries/bottom": "{type: contact wall}", "boundaries/top": "{type: outflow}", "output/fields/every_time": 0.0,
            "run/end_time": gap * H / SPEED + 3e-5, "bodies": f"{{two: {{material: steel, shape: rectangle, center: [{along!r}, {gap * H - low!r}], size: [0.1, 0.1], angle: {lean!r}, velocity: [0.0, {-SPEED}]}}}}"})
        late = SPEED * first_felt(r) / H - gap
        check(f"corner that leans by {lean:.0f} degrees, late, cells", abs(late), 5e-3)
        clean(r)


if __name__ == "__main__":
    run(globals())
