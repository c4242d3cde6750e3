# SPDX-License-Identifier: BSD-3-Clause
"""Laws of example/materials as numbers and words by key: pressure, temperature, states behind plane shocks and on the release
from them.
"""
from math import exp, log, sqrt

from harness import EXAMPLE


def law_of(name):
    """The numbers and words of a material file: one `key: value` a line."""
    law = {}
    for line in (EXAMPLE / "materials" / name).read_text().splitlines():
        key, _, value = line.split("#")[0].strip().partition(": ")
        if value:
            try:
                law[key] = float(value)
            except ValueError:
                law[key] = value
    return law


def sound_speed(law):
    return law["sound_speed"] if law["eos"] == "mie-gruneisen" else sqrt(law["bulk_modulus"] / law["density"])


def pressure(law, rho, e):
    """e = 0 in the reference state; Mie-Gruneisen in compression alone."""
    rho0 = law["density"]
    if law["eos"] == "mie-gruneisen":
        eta, gamma = 1.0 - rho0 / rho, law["gruneisen"]
        hugoniot = rho0 * law["sound_speed"] ** 2 * eta / (1.0 - law["slope"] * eta) ** 2
        return hugoniot * (1.0 - 0.5 * gamma * eta) + gamma * rho0 * e
    xi = rho / rho0
    hot = law["b"] / (1.0 + e / (law["vapour_energy"] * xi * xi)) * rho * e
    dense = law["a"] * rho * e + hot + law["bulk_modulus"] * (xi - 1.0) + law["quadratic_modulus"] * (xi - 1.0) ** 2
    boils, gone = law["incipient_vaporisation"], law["complete_vaporisation"]
    if xi >= 1.0 or e <= boils:
        return dense
    z = 1.0 / xi - 1.0
    thin = law["a"] * rho * e + (hot + law["bulk_modulus"] * (xi - 1.0) * exp(-law["beta"] * z)) * exp(-law["alpha"] * z * z)
    return dense + min((e - boils) / (gone - boils), 1.0) * (thin - dense)


def root(f, low, high):
    """Of an increasing function, by bisection."""
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if f(middle) < 0.0 else (low, middle)
    return 0.5 * (low + high)


def shocked(law, u, strength=0.0, before=(0.0, None, 0.0, 0.0)):
    """Behind a shock to velocity u: (stress, density, velocity, energy), and the shock's speed in the material's frame.

    stress = p + strength (2/3 of the yield stress); `before` likewise (density None: the reference one).
    """
    s0, rho0, u0, e0 = before
    rho0 = rho0 or law["density"]

    def behind(rho):
        # e - e0 = (s + s0) / 2 (v0 - v), p may be curved in e: iterate
        e = e0
        for _ in range(60):
            s = pressure(law, rho, e) + strength
            e = e0 + 0.5 * (s + s0) * (1.0 / rho0 - 1.0 / rho)
        return s, e

    def excess(rho):
        s, _ = behind(rho)
        return max(s - s0, 0.0) * (1.0 / rho0 - 1.0 / rho) - (u - u0) ** 2

    rho = root(excess, rho0 * (1.0 + 1e-12), (1.6 if law["eos"] == "mie-gruneisen" else 4.0) * rho0)
    s, e = behind(rho)
    return (s, rho, u, e), u0 + (s - s0) / (rho0 * (u - u0))


def release(law, rho, e, least, steps=20000):
    """Isentrope from (rho, e) down to p = 0 or the density `least`: lists of density, energy, pressure and of the velocity that
    a simple wave gives, u = integral sqrt(-dp dv). de = -p v d(ln v) by the classical Runge-Kutta rule.
    """
    def slope(log_v, e):
        return -pressure(law, exp(-log_v), e) * exp(log_v)

    states, log_v = [(rho, e, pressure(law, rho, e), 0.0)], -log(rho)
    d = log(rho / least) / steps
    for _ in range(steps):
        k1 = slope(log_v, e)
        k2 = slope(log_v + 0.5 * d, e + 0.5 * d * k1)
        k3 = slope(log_v + 0.5 * d, e + 0.5 * d * k2)
        k4 = slope(log_v + d, e + d * k3)
        e += d * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0
        log_v += d
        _, _, p0, u = states[-1]
        p = pressure(law, exp(-log_v), e)
        if p < 0.0:
            break
        states.append((exp(-log_v), e, p, u + sqrt(max(p0 - p, 0.0) * (exp(log_v) - exp(log_v - d)))))
    return list(zip(*states))


def elastic(law, yield_stress):
    """Behind the elastic precursor: q = 2 G ln(rho / rho0) reaches the yield stress."""
    rho0 = law["density"]
    rho = rho0 * exp(yield_stress / (2.0 * law["shear_modulus"]))
    e = 0.0
    for _ in range(60):
        s = pressure(law, rho, e) + 2.0 / 3.0 * yield_stress
        e = 0.5 * s * (1.0 / rho0 - 1.0 / rho)
    return s, rho, sqrt(s * (1.0 / rho0 - 1.0 / rho)), e


def temperature(law, rho, e):
    """T_s + (e - e_s) / c_v along the reference isentrope of Mie-Gruneisen or Tillotson (gamma = a + b), by Euler's mid-point rule."""
    steps, rho0 = 2000, law["density"]
    d = (1.0 / rho - 1.0 / rho0) / steps
    es, ts = 0.0, law["reference_temperature"]
    for i in range(steps):
        v = 1.0 / rho0 + (i + 0.5) * d
        gamma = law["gruneisen"] * rho0 * v if law["eos"] == "mie-gruneisen" else law["a"] + law["b"]
        cold = pressure(law, 1.0 / v, 0.0)
        middle = es - 0.5 * d * (cold + gamma / v * es)
        es -= d * (cold + gamma / v * middle)
        ts *= exp(-gamma / v * d)
    return ts + (e - es) / law["heat_capacity"]
