# SPDX-License-Identifier: BSD-3-Clause
"""Contact begins in the step that closes a gap, none earlier: several gaps at once, a corner above cells, faces and nodes, a bar that strikes the same body again."""
from math import cos, degrees, hypot, pi, radians, sin, sqrt
from random import Random

from harness import ROOT, check, clean, harmos, read_columns, run

DECKS = ROOT / "test/verification/decks"
H = 0.01
NO_FIELDS = {"output/fields/every_time": 0.0}


def loaded(r, pair):
    """Start, end [s] and force [N/m] of the cycles in which two bodies press on each other."""
    step = dict(zip(r["time"], r["dt"]))
    c = read_columns(r.directory / "contact.csv")
    rows = zip(c["time"], c["a"], c["b"], c["force_x"], c["force_y"])
    return [(t - step[t], t, hypot(x, y)) for t, a, b, x, y in rows if {a, b} == set(pair) and hypot(x, y) > 0.0]


def begins_in_time(r, pair, gap, what, early=1e-3, late=1e-3):
    """`gap(t)`: void between the bodies at a time as long as nothing touches, in cells; the first loaded cycle must close it but for `early`, `late` cells too late at most."""
    start, end, _ = loaded(r, pair)[0]
    print(f"  {what}: void {gap(start):.4f} at the start of the first loaded cycle, {gap(end):.4f} at its end")
    check("void that is left then, cells", gap(end), early)
    check("overlap at its start, cells", -gap(start), late)


def test_several_gaps_close_at_once_each_in_its_time():
    r = harmos(DECKS / "gaps.yaml", NO_FIELDS)
    for pair, width, speed in (("ab", 0.3, 30.0), ("bc", 2.04, 200.0), ("cd", 0.6, 60.0), ("de", 1e-3, 0.1)):
        begins_in_time(r, pair, lambda t: width - speed * t / H, f"{width} cells between {pair[0]} and {pair[1]}")
    check("momentum", r.summary["momentum_error"], 1e-12)
    clean(r)


def corner(x, surface, angle, gap, speed):
    """A square turned by an angle comes down on a block: its lowest corner at x, `gap` cells above the surface."""
    a, half = radians(angle), 0.05
    low = min(((p * cos(a) - q * sin(a), p * sin(a) + q * cos(a)) for p in (-half, half) for q in (-half, half)), key=lambda c: c[1])
    return harmos(DECKS / "gaps.yaml", {
        "mesh": "{x: {from: 0.0, to: 0.45, cells: 45}, y: {from: 0.0, to: 0.4, cells: 40}}", **NO_FIELDS, "run/end_time": 4e-5,
        "bodies": f"{{block: {{material: steel, shape: rectangle, center: [0.2, {surface - 0.1!r}], size: [0.3, 0.2]}}, "
                  f"tip: {{material: steel, shape: rectangle, center: [{x - low[0]!r}, {surface + gap * H - low[1]!r}], size: [{2 * half}, {2 * half}], "
                  f"angle: {angle}, velocity: [0.0, -{speed}]}}}}"})


def test_a_corner_is_felt_when_it_touches_above_a_cell_a_face_or_a_node():
    # The surface on faces, low and high in its cells. As chords within their cells corners turned by 2, 15 and 30 degrees were felt
    # through 0.19, 0.11 and 0.03 of a cell of void; 38 of 100 random places and angles too early.
    gap, speed = 0.4, 200.0
    for angle in (45.0, 15.0, 2.0):
        for surface in (0.2, 0.2037, 0.2082):
            places = ((0.2, "a node or its column"), (0.2023, "a quarter of a cell"), (0.205, "mid-cell"))
            for x, place in places + (((0.3497, "the block's corner"),) if angle == 45.0 else ()):
                r = corner(x, surface, angle, gap, speed)
                # Rows of facets stand in their middles: of a square that leans by 2 degrees, which has them, a corner beside one goes in by 0.09 cells.
                begins_in_time(r, ("block", "tip"), lambda t: gap - speed * t / H, f"{angle} degrees above {place}, surface at {surface}", late=0.1)
                check("momentum", r.summary["momentum_error"], 1e-12)
                clean(r)


def passes(side, end_time, one, two):
    """What the second of two steel bodies in the open, which moves at 200 m/s, gives the first, over its momentum."""
    r = harmos(DECKS / "gaps.yaml", {
        "mesh": f"{{x: {side}, y: {side}}}", "boundaries/bottom": "{type: outflow}", "boundaries/top": "{type: outflow}", **NO_FIELDS, "run/end_time": end_time,
        "bodies": f"{{one: {{material: steel, {one}}}, two: {{material: steel, {two}}}}}"})
    return r, max(hypot(x, y) for x, y in zip(r["one.momentum_x"], r["one.momentum_y"])) / (r.first("two.mass") * 200.0)


def passing(angle, gap, height):
    """A square slides past the face of a turned block, `gap` cells beside it, from below its lower corner to above its upper one."""
    c, s = cos(radians(angle)), sin(radians(angle))
    across, along = 0.1 + gap * H, -0.08
    return passes("{from: 0.0, to: 0.6, cells: 60}", 8e-4, f"shape: rectangle, center: [0.3037, 0.3021], size: [0.1, {height}], angle: {angle}",
                  f"shape: rectangle, center: [{0.3037 + across * c - along * s!r}, {0.3021 + across * s + along * c!r}], "
                  f"size: [0.1, 0.1], angle: {angle}, velocity: [{-200.0 * s!r}, {200.0 * c!r}]")


def test_bodies_that_pass_each_other_feel_nothing():
    # Cells with corners of both had void beyond them and none between: 1e-5 to 1.5e-2 of the momentum went across in 19 of 20.
    for height, what in (0.1, "corners past corners"), (0.3, "corners along a face"):
        for angle in (0.0, 15.0, 22.5, 30.0, 45.0):
            for gap in (0.1, 0.01, 0.002):
                r, across = passing(angle, gap, height)
                check(f"{what}, {angle} degrees, {gap} cells: momentum that goes across", across, 1e-14)
                assert not loaded(r, ("one", "two"))
                clean(r)


def disc_passes(angle, gap, shift):
    """A disc passes above the corner of a turned square, `gap` cells from it at the nearest."""
    c, s, radius, h = cos(radians(angle)), sin(radians(angle)), 0.12, 0.025
    x, y = 0.5 + shift[0] * h, 0.5 + shift[1] * h
    along, up = -0.1 - 0.09, 0.1 + radius + gap * h  # the corner at (-0.1, 0.1) of the square's own frame
    return passes("{from: 0.0, to: 1.0, cells: 40}", 9e-4, f"shape: rectangle, center: [{x!r}, {y!r}], size: [0.2, 0.2], angle: {angle}",
                  f"shape: disc, center: [{x + along * c - up * s!r}, {y + along * s + up * c!r}], radius: {radius}, "
                  f"velocity: [{200.0 * c!r}, {200.0 * s!r}]")


# Drawn as chords, discs of five cells' radius miss their centroids by 1e-4 to 7e-4 of them: the disc was not drawn apart from the corner, and of the
# first of these places 1.4e-2 of the momentum went across.
def test_a_disc_that_passes_a_corner_feels_nothing():
    for angle, shift in ((3.769, (0.982, 0.965)), (17.0, (0.31, 0.17)), (31.0, (0.62, 0.85)), (45.0, (0.5, 0.11)), (70.0, (0.05, 0.4))):
        for gap in (0.1, 0.05):
            r, across = disc_passes(angle, gap, shift)
            rows = len(read_columns(r.directory / "contact.csv")["time"])
            print(f"  {angle} degrees, {gap} cells: {rows} rows loaded, {across:.1e} of the momentum across")
            check("momentum that goes across", across, 1e-12)
            assert rows == 0
            clean(r)


def round_pair(kind, random, gap, approach, travel=0.0):
    """A disc `gap` cells from a disc, a turned square's face or its corner, of four to eight cells' radius, at a random place; moves at 20 m/s along the line of the two
    after `travel` cells, or across it, at 200 m/s in the middle of a way of `travel` cells. Returns the run."""
    h, side, far = 0.025, 0.1, 0.12
    radius, turn, away = random.uniform(4.0, 8.0) * h, random.uniform(0.0, 2.0 * pi), random.uniform(0.0, 2.0 * pi)
    u = (cos(turn), sin(turn))
    n = (cos(away), sin(away)) if kind == "disc" else (-u[1], u[0])
    x, y = (0.5 + random.uniform(0.0, 1.0) * h - far * n[k] for k in (0, 1))
    if kind == "disc":
        other = random.uniform(4.0, 8.0) * h
        one, foot = f"shape: disc, center: [{x!r}, {y!r}], radius: {other!r}", (x + other * n[0], y + other * n[1])
    else:
        one = f"shape: rectangle, center: [{x!r}, {y!r}], size: [{2 * side}, {2 * side}], angle: {degrees(turn)!r}"
        along = side if kind == "corner" else random.uniform(-0.6, 0.6) * (side - 0.5 * travel * h)
        foot = (x + along * u[0] + side * n[0], y + along * u[1] + side * n[1])
        if kind == "corner":
            lean = radians(random.uniform(10.0, 80.0))
            n = (cos(lean) * u[0] + sin(lean) * n[0], cos(lean) * u[1] + sin(lean) * n[1])
    speed = 200.0 if travel > 0.0 and not approach else 20.0
    velocity = [-speed * n[0], -speed * n[1]] if approach else [-speed * n[1], speed * n[0]]
    way = travel * h if approach else 0.5 * travel * h
    centre = [foot[k] + (radius + gap * h) * n[k] - way * velocity[k] / speed for k in (0, 1)]
    end_time = (travel + 4.0 * gap) * h / speed if approach else max(3e-6, travel * h / speed)
    return harmos(DECKS / "gaps.yaml", {
        "mesh": "{x: {from: -0.1, to: 1.1, cells: 48}, y: {from: -0.1, to: 1.1, cells: 48}}", "boundaries/bottom": "{type: outflow}", "boundaries/top": "{type: outflow}",
        "output/fields": "{at_end: false}", "run": f"{{end_time: {end_time!r}}}",
        "bodies": f"{{one: {{material: steel, {one}}}, two: {{material: steel, shape: disc, center: {centre!r}, radius: {radius!r}, velocity: {velocity!r}}}}}"})


# With the gaps of chords alone 1, 6 and 7 of 12 discs beside discs were felt at 0.02, 0.005 and 0.002 cells, 0, 4 and 1 beside faces.
def test_what_is_round_feels_nothing_before_it_touches():
    random = Random(7)
    for kind in ("disc", "face", "corner"):
        for gap in (0.02, 0.005) if kind == "corner" else (0.02, 0.005, 0.002):
            felt = [len(read_columns(round_pair(kind, random, gap, False).directory / "contact.csv")["time"]) for _ in range(8)]
            print(f"  a disc past a {kind}, {gap} cells: rows loaded {felt}")
            assert not any(felt), felt


# With the gaps of chords up to 0.02 cells early. Rows stand at middles of segments: up to 1 / (8 R) late.
def test_what_is_round_is_felt_when_it_touches():
    random, gap = Random(7), 0.02
    for kind in ("disc", "face"):
        for _ in range(8):
            begins_in_time(round_pair(kind, random, gap, True), ("one", "two"), lambda t: gap - 20.0 * t / 0.025, f"a disc on a {kind}", early=1e-3, late=0.05)


# What has moved is a polygon of chords, whose ends stand out of the arc by up to 0.04 cells at these radii. Without what fitSide and curvedGap allow for that,
# discs of four cells' radius felt a face 0.02 cells away in 4 of 8 places, 0.01 in 8 of 8 (up to 2e-3 of their momentum), and were felt 0.03 (faces) and 0.04 (discs) early.
def test_what_is_round_and_has_moved_feels_what_it_touches():
    random = Random(11)
    for kind in ("disc", "face"):
        felt = []
        for _ in range(8):
            r = round_pair(kind, random, 0.02, False, travel=5.0)
            felt.append(len(read_columns(r.directory / "contact.csv")["time"]))
            clean(r)
        print(f"  a disc past a {kind}, 0.02 cells, five cells along: rows loaded {felt}")
        # Beside faces of eight cells some discs pass the square's corner as well: where its cell is drawn with the disc they may feel it, three of 38.
        assert sum(rows > 0 for rows in felt) <= (1 if kind == "face" else 0), felt
        for _ in range(6):
            r = round_pair(kind, random, 0.02, True, travel=4.0)
            begins_in_time(r, ("one", "two"), lambda t: 4.02 - 20.0 * t / 0.025, f"a disc that has moved by four cells on a {kind}", early=0.01, late=0.02)
            clean(r)


# A corner's tip that just comes into the disc's cell was a film along all of the cell's side: one of these eight felt it for ten cycles.
def test_what_is_round_and_has_moved_feels_no_corner_that_it_passes():
    random = Random(7)
    felt = []
    for _ in range(8):
        r = round_pair("corner", random, 0.05, False, travel=5.0)
        felt.append(len(read_columns(r.directory / "contact.csv")["time"]))
        clean(r)
    print(f"  a disc past a corner, 0.05 cells, five cells along: rows loaded {felt}")
    assert not any(felt), felt


def test_a_bar_strikes_the_same_body_again_after_it_has_parted():
    # Between two fixed blocks, frictionless: right, left, right again. In between no force at all.
    left, right, speed = 0.1, 0.45, 50.0
    r = harmos(DECKS / "gaps.yaml", {
        "materials/rock": "{eos: rigid, density: 7800.0}", "mesh": "{x: {from: 0.0, to: 0.6, cells: 60}, y: {from: 0.0, to: 0.03, cells: 3}}", **NO_FIELDS, "run/end_time": 1.05e-2,
        "bodies": f"{{left: {{material: rock, shape: rectangle, center: [{left - 0.1!r}, 0.0], size: [0.2, 1.0], motion: fixed}}, "
                  f"right: {{material: rock, shape: rectangle, center: [{right + 0.1!r}, 0.0], size: [0.2, 1.0], motion: fixed}}, "
                  f"bar: {{material: steel, shape: rectangle, center: [0.2537, 0.0], size: [0.2, 1.0], velocity: [{speed}, 0.0]}}}}"})
    visits = []
    for wall in ("left", "right"):
        previous = None
        for start, end, _ in loaded(r, ("bar", wall)):
            if previous is None or start - previous > 1e-4:
                visits.append([start, end, wall])
            visits[-1][1] = previous = end
    visits.sort()
    print("  visits:", ", ".join(f"{wall} {1e3 * start:.3f} to {1e3 * end:.3f} ms" for start, end, wall in visits))
    assert [wall for _, _, wall in visits] == ["right", "left", "right"], visits
    exact = 2.0 * 0.2 / sqrt(4600.0**2 + 4.0 * 80.0e9 / (3.0 * 7800.0))
    for start, end, wall in visits:
        i = min(range(len(r["time"])), key=lambda k: abs(r["time"][k] - start))
        void = (right - r["bar.x_max"][i] if wall == "right" else r["bar.x_min"][i] - left) / H
        check(f"{wall}: void at the start of its first cycle, in travels of the bar in a cycle", void / (speed * r["dt"][i + 1] / H), 1.5)
        check("overlap at its start, cells", -void, 1e-3)
        check("duration, over 2 L / c", abs((end - start) / exact - 1.0), 0.1)
    clean(r)


if __name__ == "__main__":
    run(globals())
