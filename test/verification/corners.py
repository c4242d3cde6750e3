# SPDX-License-Identifier: BSD-3-Clause
"""Corners of deformable squares on faces of blocks: nothing is felt through void, and what acts is along the face's normal."""
from math import cos, hypot, radians, sin, sqrt
from random import Random

from harness import ROOT, check, clean, harmos, read_columns, run

H = 0.01
SPEED = 20.0  # at which corners come down [m/s]


class Scene:
    """A steel block whose upper side is inclined by a random angle, at a random place of the mesh, and a square on its corner above it."""

    def __init__(self, random, lean):
        self.angle, self.lean = random.uniform(0.0, 90.0), random.uniform(*lean)
        a = radians(self.angle)
        self.along, self.normal = (cos(a), sin(a)), (-sin(a), cos(a))
        self.middle = tuple(0.3 + random.random() * H for _ in range(2))

    def run(self, along, gap, velocity, end_time):
        """`along`, `gap`: of the corner in cells; `velocity`: of the square, along the face and up."""
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
            "bodies": f"{{one: {{material: steel, shape: rectangle, center: {block!r}, size: [0.2, 0.1], angle: {self.angle!r}}}, "
                      f"two: {{material: steel, shape: rectangle, center: {square!r}, size: [0.1, 0.1], angle: {self.angle + self.lean!r}, velocity: {v!r}}}}}"})


# With the means of face and edge for normals 10 of 60 felt 2e-5 to 5e-4 of the momentum, for a cycle each.
def test_a_corner_that_slides_along_a_face_feels_nothing():
    random = Random(12)
    for gap in (0.003, 0.001):
        felt = 0
        for _ in range(16):
            r = Scene(random, (5.0, 85.0)).run(random.uniform(-3.0, 3.0), gap, (200.0, 0.0), 1.2e-4)
            felt += len(read_columns(r.directory / "contact.csv")["time"]) > 0
            clean(r)
        check(f"{gap} cells above it, squares of 16 that feel the block", felt, 0)


def struck(scene, along, slide):
    """Impulse along the face over that along its normal, and void left when the corner is first felt. [cells]"""
    gap = 0.3
    r = scene.run(along, gap, (slide, -SPEED), gap * H / SPEED + 3e-4)
    p = r.last("one.momentum_x"), r.last("one.momentum_y")
    tangent, normal = (sum(p[k] * d[k] for k in (0, 1)) for d in (scene.along, scene.normal))
    c = read_columns(r.directory / "contact.csv")
    first = min(t for t, x, y in zip(c["time"], c["force_x"], c["force_y"]) if hypot(x, y) > 0.0)
    check("momentum", r.summary["momentum_error"], 1e-12)
    clean(r)
    return tangent / -normal, gap - SPEED * first / H


# On meshes of half and a quarter of the cells 1e-3 to 4e-3 along the face. With rows in the middle of facets and the means of face
# and edge for normals a tenth (root mean square), and up to a quarter of a cell late.
def test_a_corner_strikes_along_the_normal_of_the_face():
    random = Random(5)
    for slide in (0.0, 100.0):
        found = [struck(Scene(random, (5.0, 85.0)), random.uniform(-1.0, 1.0), slide) for _ in range(16)]
        ratio, void = sorted(abs(f[0]) for f in found), [f[1] for f in found]
        print(f"  along over normal impulse, sliding at {slide} m/s: median {ratio[8]:.1e}, root mean square {sqrt(sum(x * x for x in ratio) / 16):.1e}, largest {ratio[-1]:.1e}")
        check("median", ratio[8], 0.01)
        check("root mean square", sqrt(sum(x * x for x in ratio) / 16), 0.07)
        check("felt through, cells", max(void), 1e-3)
        check("late, cells", -min(void), 0.1)


run(globals())
