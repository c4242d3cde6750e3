# SPDX-License-Identifier: BSD-3-Clause
"""Elastic step wave at an oblique interface, bonded and sliding: the two transmitted and the two reflected waves, each by itself, against plane-wave theory (Zoeppritz)."""
from math import atan2, cos, degrees, radians, sin, sqrt

import numpy

from harness import check, clean, harmos, read_columns, run

DECK = "oblique_wave/deck.yaml"
STEEL, ALUMINIUM = (7800.0, 4600.0, 80.0e9), (2700.0, 5000.0, 27.0e9)
AMPLITUDE = 1.0  # of the incident velocity: half of the driver's
CENTRE, START = numpy.array([1.7, 1.25]), 0.6  # of the interface; where the wave starts [m]
DOWN, DEPTH = 0.35, 0.3  # of the probes: along the interface, away from its end that the wave meets first; from the interface [m]


class Wave:
    """Plane wave v = d f(t - s.x) of unit amplitude in a medium (density, bulk sound speed, shear modulus)."""

    def __init__(self, medium, shear, along, sign, n, t):
        rho, c0, mu = medium
        lame = rho * c0 * c0 - 2.0 / 3.0 * mu
        speed = sqrt(mu / rho) if shear else sqrt((lame + 2.0 * mu) / rho)
        across = sign * sqrt(1.0 / speed**2 - along**2)
        self.s = s = across * n + along * t
        way = s * speed
        self.d = numpy.array([-way[1], way[0]]) if shear else way
        self.stress = -(lame * (s @ self.d) * numpy.eye(2) + mu * (numpy.outer(s, self.d) + numpy.outer(self.d, s)))


def waves(angle, bonded):
    """(wave, its amplitude over the incident one) of the longitudinal and the shear wave in front of the interface and behind it; the
    interface's normal is `angle` off the incident wave's direction."""
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
    return list(zip(first + second, amplitude)), incident


def compare(angle, bonded, bound, refinement=1):
    """Far enough from the interface the longitudinal wave has passed before the shear wave comes, and that before anything comes from the ends."""
    a = radians(angle)
    n, t = numpy.array([cos(a), sin(a)]), numpy.array([-sin(a), cos(a)])
    vector = lambda x: f"[{x[0]!r}, {x[1]!r}]".replace("np.float64(", "").replace(")", "")
    foot = CENTRE - DOWN * t
    at = {"beyond": foot + DEPTH * n, "front": foot - DEPTH * n}
    r = harmos(DECK, {"bodies/behind/normal": vector(-n), "bodies/before/normal": vector(n),
                      "mesh/x/cells": 144 * refinement, "mesh/y/cells": 120 * refinement,
                      "interactions/default": "bonded" if bonded else "sliding",
                      **{f"probes/{name}/position": vector(x) for name, x in at.items()},
                      "output/fields/every_time": 0.0})
    p = read_columns(r.directory / "probes.csv")
    theory, incident = waves(angle, bonded)
    arrives = incident.s @ (foot - numpy.array([START, foot[1]]))  # at the foot
    front = 1.6e-5 / sqrt(refinement)  # time that a front takes to pass

    def mean(probe, first, last):
        rows = zip(p["name"], p["time"], p["velocity_x"], p["velocity_y"])
        return numpy.array([(x, y) for name, time, x, y in rows if name == probe and first < time < last]).mean(axis=0)

    for probe, before, (longitudinal, shear) in (("beyond", numpy.zeros(2), theory[2:]), ("front", AMPLITUDE * incident.d, theory[:2])):
        time = [arrives + w.s @ (at[probe] - foot) for w, _ in (longitudinal, shear)]
        first = mean(probe, time[0] + front, time[1] - 0.6 * front) - before
        second = mean(probe, time[1] + front, time[1] + front + 2.0e-5) - before - first
        for name, found, (w, amplitude) in ((f"longitudinal, {probe}", first, longitudinal), (f"shear, {probe}", second, shear)):
            exact = AMPLITUDE * amplitude * w.d
            turned = degrees(atan2(exact[0] * found[1] - exact[1] * found[0], exact @ found))
            print(f"  {angle} degrees, {'bonded' if bonded else 'sliding'}, {name}: amplitude {found @ w.d:+.4f} (exact {AMPLITUDE * amplitude:+.4f}), turned by {turned:.1f} degrees")
            check("off, over the incident velocity", float(numpy.linalg.norm(found - exact)) / AMPLITUDE, bound)
    clean(r)


def test_normal_incidence_of_the_theory_is_the_impedance_rule():
    z = [rho * sqrt(c0 * c0 + 4.0 * g / (3.0 * rho)) for rho, c0, g in (STEEL, ALUMINIUM)]
    check("theory against 2 Z1/(Z1 + Z2)", abs(waves(0.0, True)[0][2][1] - 2.0 * z[0] / (z[0] + z[1])), 1e-12)


# What is off falls with the cells: a shear wave's front is some ten of them wide.
def test_a_bonded_interface_transmits_and_reflects_what_theory_says():
    for angle, refinement, bound in ((20.0, 1, 0.03), (35.0, 1, 0.035), (20.0, 2, 0.01)):
        compare(angle, True, bound, refinement)


def test_a_sliding_interface_transmits_and_reflects_what_theory_says():
    for angle, refinement, bound in ((20.0, 1, 0.04), (35.0, 1, 0.05), (20.0, 2, 0.013)):
        compare(angle, False, bound, refinement)


if __name__ == "__main__":
    run(globals())
