# SPDX-License-Identifier: BSD-3-Clause
"""Elastic step wave at an oblique interface, bonded and sliding: velocities of the transmitted and the reflected waves against plane-wave theory (Zoeppritz)."""
from math import cos, radians, sin, sqrt

import numpy

from harness import ROOT, check, clean, harmos, read_columns, run

DECK = ROOT / "test/verification/decks/oblique_interface.yaml"
STEEL, ALUMINIUM = (7800.0, 4600.0, 80.0e9), (2700.0, 5000.0, 27.0e9)
AMPLITUDE = 1.0  # of the incident velocity: half of the driver's


class Wave:
    """Plane wave v = d f(t - s.x) of unit amplitude in a medium (density, bulk sound speed, shear modulus)."""

    def __init__(self, medium, shear, along, sign, n, t):
        rho, c0, mu = medium
        lame = rho * c0 * c0 - 2.0 / 3.0 * mu
        speed = sqrt(mu / rho) if shear else sqrt((lame + 2.0 * mu) / rho)
        across = sign * sqrt(1.0 / speed**2 - along**2)
        s = across * n + along * t
        way = s * speed
        self.d = numpy.array([-way[1], way[0]]) if shear else way
        self.stress = -(lame * (s @ self.d) * numpy.eye(2) + mu * (numpy.outer(s, self.d) + numpy.outer(self.d, s)))


def waves(angle, bonded):
    """Velocities of the reflected and of the transmitted waves, longitudinal and shear in sum; the interface's normal is `angle` off the incident wave's direction."""
    a = radians(angle)
    n, t = numpy.array([cos(a), sin(a)]), numpy.array([-sin(a), cos(a)])
    rho, c0, mu = STEEL
    along = (numpy.array([1.0, 0.0]) @ t) / sqrt(c0 * c0 + 4.0 * mu / (3.0 * rho))
    incident = Wave(STEEL, False, along, 1.0, n, t)
    first = [Wave(STEEL, shear, along, -1.0, n, t) for shear in (False, True)]
    second = [Wave(ALUMINIUM, shear, along, 1.0, n, t) for shear in (False, True)]

    def conditions(w, side):
        """What vanishes when summed over all waves, side 1 in front and -1 behind."""
        v, force = w.d, w.stress @ n
        if bonded:
            return [side * v @ n, side * v @ t, side * force @ n * 1e-7, side * force @ t * 1e-7]
        shear = force @ t * 1e-7
        return [side * v @ n, side * force @ n * 1e-7, shear if side > 0 else 0.0, shear if side < 0 else 0.0]

    matrix = numpy.array([conditions(w, 1.0) for w in first] + [conditions(w, -1.0) for w in second]).T
    amplitude = numpy.linalg.solve(matrix, -numpy.array(conditions(incident, 1.0)))
    reflected = amplitude[0] * first[0].d + amplitude[1] * first[1].d
    transmitted = amplitude[2] * second[0].d + amplitude[3] * second[1].d
    return AMPLITUDE * reflected, AMPLITUDE * transmitted


def compare(angle, bonded, bound):
    a = radians(angle)
    normal = lambda sign: f"[{sign * cos(a)!r}, {sign * sin(a)!r}]"
    r = harmos(DECK, {"bodies/behind/normal": normal(-1.0), "bodies/before/normal": normal(1.0),
                      "interactions/default": "bonded" if bonded else "sliding",
                      "output/fields/every_time": 0.0, "output/fields/at_end": "false"})
    p = read_columns(r.directory / "probes.csv")
    kind = "bonded" if bonded else "sliding"

    def late(probe):
        rows = zip(p["name"], p["time"], p["velocity_x"], p["velocity_y"])
        return numpy.array([(x, y) for name, time, x, y in rows if name == probe and 1.6e-4 < time < 1.9e-4]).mean(axis=0)

    incident = numpy.array([AMPLITUDE, 0.0])
    reflected, transmitted = waves(angle, bonded)
    for what, found, exact in (("transmitted", late("near"), transmitted), ("reflected", late("before") - incident, reflected)):
        print(f"  {angle} degrees, {kind}, {what}: ({found[0]:.4f}, {found[1]:.4f}), exact ({exact[0]:.4f}, {exact[1]:.4f})")
        check("off, over the incident velocity", float(numpy.linalg.norm(found - exact)) / AMPLITUDE, bound)
    clean(r)


def test_normal_incidence_of_the_theory_is_the_impedance_rule():
    z = [rho * sqrt(c0 * c0 + 4.0 * g / (3.0 * rho)) for rho, c0, g in (STEEL, ALUMINIUM)]
    check("theory against 2 Z1/(Z1 + Z2)", abs(waves(0.0, True)[1][0] - 2.0 * z[0] / (z[0] + z[1])), 1e-12)


def test_a_bonded_interface_transmits_and_reflects_what_theory_says():
    for angle in (20.0, 35.0):
        compare(angle, True, 0.01)


def test_a_sliding_interface_transmits_and_reflects_what_theory_says():
    compare(20.0, False, 0.025)


if __name__ == "__main__":
    run(globals())
