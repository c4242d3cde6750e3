# SPDX-License-Identifier: BSD-3-Clause
"""Plates of every file of example/materials: shock state on the Hugoniot, elastic precursor, stress on the yield surface; of
Tillotson's metals the release from the shocked state.

Exact: jump conditions of mass, momentum and energy with the law's own pressure (strength off: one shock; perfectly plastic: an
elastic and a plastic one) and the isentrope behind a free surface, solved here. The yield stress is evaluated here too, at the
state that the probe reports.
"""
from math import log, sqrt

import h5py
import numpy

from harness import EXAMPLE, ROOT, check, clean, harmos, read_columns, run
from hugoniot import elastic, law_of, release, shocked, sound_speed, temperature

DECK = str(ROOT / "test/verification/decks/plate.yaml")
NEAR, FAR = 0.02, 0.04  # probes
FILES = sorted(path.name for path in (EXAMPLE / "materials").glob("*.yaml"))


def plate(name, u, end, **more):
    settings = {"materials/metal": f"{{from: {EXAMPLE / 'materials' / name}}}", "bodies/plate/velocity": f"[{-u}, 0.0]",
                "run/end_time": end}
    settings.update({key.replace("__", "/"): value for key, value in more.items()})
    r = harmos(DECK, settings)
    probes = read_columns(r.directory / "probes.csv")
    rows = {p: {c: [v for v, n in zip(values, probes["name"]) if n == p] for c, values in probes.items()} for p in ("near", "far")}
    for q in rows.values():
        q["stress"] = [p + 2.0 / 3.0 * m for p, m in zip(q["pressure"], q["von_mises"])]
    return r, rows["near"], rows["far"]


def arrival(probe, column, level):
    """Time when a column first reaches a level, linear between rows."""
    values = probe[column]
    i = next(i for i, v in enumerate(values) if v >= level)
    part = (level - values[i - 1]) / (values[i] - values[i - 1])
    return probe["time"][i - 1] + part * (probe["time"][i] - probe["time"][i - 1])


def mean(probe, column, start, end):
    values = [v for v, t in zip(probe[column], probe["time"]) if start < t < end]
    return sum(values) / len(values)


def speed_between(near, far, level):
    return (FAR - NEAR) / (arrival(far, "stress", level) - arrival(near, "stress", level))


def test_shock_states_lie_on_the_hugoniot():
    u = 500.0
    for name in FILES:
        law = law_of(name)
        (stress, rho, _, _), speed = shocked(law, u)
        # at rest behind the shock, which runs with Us - u through the mesh
        end = 1.25 * FAR / (speed - u)
        r, near, far = plate(name, u, end, materials__metal__strength="none") if "strength" in law else plate(name, u, end)
        after = arrival(near, "stress", 0.5 * stress) + 0.15 * NEAR / (speed - u)
        measured = mean(near, "pressure", after, end)
        print(f"  {name}: {stress / 1e9:.3f} GPa, Us {speed:.1f} m/s")
        check("pressure", abs(measured / stress - 1.0), 5e-3)
        check("density", abs(mean(near, "density", after, end) / rho - 1.0), 1e-3)
        check("shock speed", abs((speed_between(near, far, 0.5 * stress) + u) / speed - 1.0), 3e-3)
        check("energy ledger", r.summary["energy_error"], 1e-10)
        assert not r.summary["warnings"], r.summary["warnings"]
        clean(r)


def last_pairs(r):
    """Centres of the cells, density, energy, pressure and velocity of all pairs in the last output."""
    with h5py.File(sorted(r.directory.glob("fields_*.h5"))[-1]) as file:
        x = file["/nodes/position"][:][file["/cells/connectivity"][:]].mean(axis=1)[:, 0]
        return (x[file["/pairs/cell"][:].astype(int)], file["/pairs/density"][:], file["/pairs/internal_energy"][:],
                file["/pairs/pressure"][:], file["/pairs/velocity"][:, 0])


def released(name, u):
    """A plate that has been shocked to u and released by its free surface, while the fan runs back through nine tenths of it:
    errors of energy and velocity in the fan, and of velocity, density and residual energy behind it.
    """
    length, cells = 0.03, 240
    law = law_of(name)
    (stress, rho, _, e), speed = shocked(law, u)
    densities, energies, pressures, velocities = (numpy.array(c) for c in release(law, rho, e, 0.02 * law["density"]))
    sound = sqrt((pressures[1] - pressures[0]) / (densities[1] - densities[0]))
    out, surface = length / speed, (speed - u) * length / speed
    end, h = out + 0.9 * surface / sound, length / cells
    freed = surface + velocities[-1] * (end - out)  # the free surface at the end
    columns = int(max(length, freed) / h) + 10
    r = harmos(DECK, {"materials/metal": f"{{from: {EXAMPLE / 'materials' / name}}}", "materials/metal/strength": "none",
                      "bodies/plate/size": f"[{2.0 * length}, 1.0]", "bodies/plate/velocity": f"[{-u}, 0.0]",
                      "mesh/x/cells": columns, "mesh/x/to": columns * h, "mesh/y/to": h, "run/end_time": end,
                      "output/fields/at_end": "true", "probes/near/position": f"[{h}, {0.5 * h}]",
                      "probes/far/position": f"[{2.0 * h}, {0.5 * h}]"})
    x, density, energy, pressure, velocity = last_pairs(r)
    fan = (pressure < 0.95 * stress) & (pressure > 0.05 * stress)
    along = lambda column: numpy.interp(-density[fan], -densities, column)
    slowest = sqrt((pressures[-2] - pressures[-1]) / (densities[-2] - densities[-1]))
    tail = surface + (velocities[-1] - slowest) * (end - out)
    free = (x > tail + 0.3 * (freed - tail)) & (x < freed - 0.1 * (freed - tail))
    print(f"  {name}: {stress / 1e9:.1f} GPa, free surface {u + velocity[free].mean():.1f} m/s (exact {u + velocities[-1]:.1f}), left "
          f"{energy[free].mean() / 1e6:.4f} MJ/kg ({energies[-1] / 1e6:.4f}), {density[free].mean():.1f} kg/m3 ({densities[-1]:.1f})")
    assert fan.sum() > 40 and free.sum() > 25
    check("energy in the fan, over the shock's", float(abs(energy[fan] - along(energies)).max() / e), 0.015)
    check("velocity in the fan, over the release's", float(abs(velocity[fan] - along(velocities)).max() / velocities[-1]), 0.007)
    check("velocity of the free surface", abs((u + velocity[free].mean()) / (u + velocities[-1]) - 1.0), 2e-3)
    check("density after the release", abs(density[free].mean() / densities[-1] - 1.0), 5e-3)
    check("energy left after the release, over the shock's", abs(energy[free].mean() - energies[-1]) / e, 0.01)
    clean(r)
    return u + velocity[free].mean()


def test_release_of_tillotson_s_metals_follows_the_isentrope_to_the_free_surface():
    # the last of aluminium passes into the region where solid and vapour are mixed
    for name, speeds in (("aluminium-tillotson.yaml", (2000.0, 3350.0, 6000.0)), ("iron-tillotson.yaml", (1000.0, 3000.0))):
        for u in speeds:
            released(name, u)


def test_free_surface_of_weakly_shocked_aluminium_has_twice_the_velocity_behind_the_shock():
    # the rule of Walsh & Christian, Phys. Rev. 97 (1955) 1544, for metals shocked to some 35 GPa
    for u in (500.0, 1000.0, 1600.0):
        check("off two", abs(released("aluminium-tillotson.yaml", u) / (2.0 * u) - 1.0), 0.01)


def test_perfectly_plastic_plates_send_the_elastic_precursor_ahead():
    u = 200.0
    for name in FILES:
        law = law_of(name)
        if "strength" not in law:
            continue
        y = law["yield_stress"]
        hel = elastic(law, y)
        limit = y * (law["density"] * sound_speed(law) ** 2 / (2.0 * law["shear_modulus"]) + 2.0 / 3.0)
        speed = hel[0] / (law["density"] * hel[2])  # of the elastic shock; linear elasticity: cL
        (stress, _, _, _), plastic_speed = shocked(law, u, 2.0 / 3.0 * y, hel)
        end = 1.3 * FAR / (plastic_speed - u)
        r, near, far = plate(name, u, end, materials__metal__strength="plastic", materials__metal__hardening_modulus=0.0)
        first, last = arrival(far, "stress", 0.5 * hel[0]), arrival(far, "stress", 0.5 * (hel[0] + stress))
        plateau = mean(far, "stress", first + 0.3 * (last - first), first + 0.5 * (last - first))
        final = mean(near, "stress", arrival(near, "stress", 0.5 * (hel[0] + stress)) + 0.2 * NEAR / (plastic_speed - u), end)
        print(f"  {name}: HEL {hel[0] / 1e9:.4f} GPa (linear {limit / 1e9:.4f}), measured {plateau / 1e9:.4f}; precursor {speed:.0f} m/s")
        check("stress of the precursor", abs(plateau / hel[0] - 1.0), 5e-3)
        check("linear formula Y (K / 2G + 2/3)", abs(plateau / limit - 1.0), 0.02)
        check("precursor speed", abs((speed_between(near, far, 0.5 * hel[0]) + u) / speed - 1.0), 5e-3)
        check("stress behind both waves", abs(final / stress - 1.0), 5e-3)
        clean(r)


def yield_stress(law, eps, rate, rho, p, e):
    t = temperature(law, rho, e)
    if law["strength"] == "johnson-cook":
        homologous = (t - law["reference_temperature"]) / (law["melting_temperature"] - law["reference_temperature"])
        work = law["yield_stress"] + law["hardening_modulus"] * eps ** law["hardening_exponent"]
        return work * (1.0 + law["rate_coefficient"] * log(max(rate, 1.0))) * (1.0 - max(homologous, 0.0) ** law["softening_exponent"])
    strain = eps + law.get("initial_plastic_strain", 0.0)
    work = law["yield_stress"] * (1.0 + law["hardening_coefficient"] * strain) ** law["hardening_exponent"]
    factor = 1.0 + law["pressure_coefficient"] * p * (rho / law["density"]) ** (-1.0 / 3.0) - \
        law["temperature_coefficient"] * (t - 300.0)
    return min(work, law["largest_yield_stress"]) * factor


def flow_behind_the_shock(name, **more):
    """Equivalent stress where the plastic strain grows fastest, and what the law gives there; also at rest. [Pa]"""
    law = {**law_of(name), **more}
    u = 300.0
    _, speed = shocked(law, u)
    # the deck returns the kinetic energy that the remap loses, which does not go with damage
    settings = {**more, **({"damage": "none"} if "damage" in law else {})}
    r, near, _ = plate(name, u, 1.1 * FAR / (speed - u), **{f"materials__metal__{key}": value for key, value in settings.items()})
    # while the front passes the probe the material flows: the row where the stress rises fastest in plastic strain
    eps = near["plastic_strain"]
    rates = [(b - a) / (t1 - t0) if t1 > t0 else 0.0 for a, b, t0, t1 in zip(eps, eps[1:], near["time"], near["time"][1:])]
    i = max(range(len(rates)), key=rates.__getitem__) + 1
    y = [yield_stress(law, eps[i], rate, near["density"][i], near["pressure"][i], near["internal_energy"][i])
         for rate in (1.0, rates[i - 1])]
    q = near["von_mises"][i]
    print(f"  {name}: q {q / 1e6:.1f} MPa, at rest {y[0] / 1e6:.1f}, at {rates[i - 1]:.1e}/s {y[1] / 1e6:.1f}")
    clean(r)
    return q, y[1]


def test_the_stress_behind_the_shock_is_on_the_yield_surface():
    for name in FILES:
        if "strength" in law_of(name):
            q, y = flow_behind_the_shock(name)
            check("equivalent stress on the yield surface of its rate", abs(q / y - 1.0), 0.02)


def test_work_hardening_before_the_run_adds_to_that_of_the_shock():
    name = "aluminium-6061-t6-steinberg-guinan.yaml"
    soft, _ = flow_behind_the_shock(name)
    hard, y = flow_behind_the_shock(name, initial_plastic_strain=0.5)
    check("equivalent stress on the surface of the sum of both strains", abs(hard / y - 1.0), 0.02)
    assert hard > 1.2 * soft


def test_leaving_the_range_is_a_warning_with_its_place():
    # torn off the wall at 2 km/s without a tension limit: no stable pressure is left
    torn = {"materials__metal__strength": "none", "run__max_cycles": 60}
    r, _, _ = plate("copper-johnson-cook.yaml", -2000.0, 2e-6, **torn)
    words = [w for w in r.summary["warnings"] if "range of the equation of state" in w]
    print("  " + words[0])
    assert "cell " in words[0] and "material plate" in words[0], words
    assert words[0] in r.text
    clean(r)
    torn["run__max_cycles"] = 40  # in the end the cell that the plate leaves behind is too thin for any range
    r, _, _ = plate("copper-johnson-cook.yaml", -2000.0, 2e-6, materials__metal__tension_limit=1.0e9, **torn)
    assert not r.summary["warnings"], r.summary["warnings"]
    clean(r)


if __name__ == "__main__":
    run(globals())
