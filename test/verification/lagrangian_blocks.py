# SPDX-License-Identifier: BSD-3-Clause
"""Body-fitted meshes: blocks with arcs and grading, Gmsh files, what they refuse, and a run that says where it folds."""
from math import cos, pi, sin, sqrt

from harness import check, clean, harmos, run, scratch_folder
from shocks import surface_radii

DECK = "verney/lagrangian.yaml"
QUIET = {"output/fields/every_time": 0.0}
SHORT = {**QUIET, "run/end_time": 2.0e-5}
RADIAL, ANGULAR = 10, 60
PART = ("{material: beryllium, shape: mesh part, part: shell, radial_velocity: -490.299, radial_radius: 0.08, "
        "radial_exponent: -1.0}")


def ring(version):
    """The quadrant of the deck as a Gmsh file: cells turned clockwise in places, boundaries as physical curves."""
    node = {}
    lines = []
    for j in range(ANGULAR + 1):
        for i in range(RADIAL + 1):
            r, phi = 0.08 + 0.02 * i / RADIAL, 0.5 * pi * j / ANGULAR
            node[i, j] = len(lines) + 1
            lines.append((r * cos(phi) if j < ANGULAR else 0.0, r * sin(phi)))
    bottom = [(node[i, 0], node[i + 1, 0]) for i in range(RADIAL)]
    left = [(node[i, ANGULAR], node[i + 1, ANGULAR]) for i in range(RADIAL)]
    quads = [(node[i, j], node[i + 1, j], node[i + 1, j + 1], node[i, j + 1]) for j in range(ANGULAR) for i in range(RADIAL)]
    quads = [q if k % 3 else q[::-1] for k, q in enumerate(quads)]
    names = '$PhysicalNames\n3\n1 1 "bottom"\n1 2 "left"\n2 3 "shell"\n$EndPhysicalNames\n'
    if version == "2.2":
        text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names + f"$Nodes\n{len(lines)}\n"
        text += "".join(f"{k + 1} {x!r} {y!r} 0\n" for k, (x, y) in enumerate(lines))
        elements = [f"1 2 1 1 {a} {b}" for a, b in bottom] + [f"1 2 2 2 {a} {b}" for a, b in left]
        elements += [f"3 2 3 1 {a} {b} {c} {d}" for a, b, c, d in quads]
        text += f"$EndNodes\n$Elements\n{len(elements)}\n"
        return text + "".join(f"{k + 1} {e}\n" for k, e in enumerate(elements)) + "$EndElements\n"
    text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + names
    text += "$Entities\n0 2 1 0\n1 0 0 0 1 1 0 1 1 0\n2 0 0 0 1 1 0 1 2 0\n1 0 0 0 1 1 0 1 3 0\n$EndEntities\n"
    text += f"$Nodes\n1 {len(lines)} 1 {len(lines)}\n2 1 0 {len(lines)}\n"
    text += "".join(f"{k + 1}\n" for k in range(len(lines))) + "".join(f"{x!r} {y!r} 0\n" for x, y in lines)
    total = len(bottom) + len(left) + len(quads)
    text += f"$EndNodes\n$Elements\n3 {total} 1 {total}\n"
    number = 0
    for dimension, entity, kind, elements in ((1, 1, 1, bottom), (1, 2, 1, left), (2, 1, 3, quads)):
        text += f"{dimension} {entity} {kind} {len(elements)}\n"
        for element in elements:
            number += 1
            text += f"{number} " + " ".join(map(str, element)) + "\n"
    return text + "$EndElements\n"


def from_file(text, settings, expect=0, part=PART):
    folder = scratch_folder()
    (folder / "shell.msh").write_text(text)
    return harmos(DECK, {**settings, "mesh/file": folder / "shell.msh", "bodies/shell": part}, expect=expect)


def test_block_with_arcs_stops_at_verney_s_radius():
    r = harmos(DECK, QUIET)
    (inner, _), (outer, spread) = surface_radii(r)
    print(f"  outer radius {100 * outer:.4f} cm (exact 7.2111, spread {100 * spread:.4f}), inner {100 * inner:.4f}")
    check("outer radius", abs(outer / 0.072111 - 1.0), 5e-3)
    check("energy ledger", r.summary["energy_error"], 1e-10)
    clean(r)


def test_gmsh_files_of_both_versions_give_the_block_s_run():
    block = harmos(DECK, SHORT)
    for version in ("2.2", "4.1"):
        r = from_file(ring(version), SHORT)
        for column in ("mass", "kinetic_energy", "internal_energy", "shell.x_max", "shell.plastic_strain_max"):
            check(f"{version}: {column}", abs(r.last(column) / block.last(column) - 1.0), 1e-9)
        clean(r)
    clean(block)


def test_graded_cells_keep_the_body():
    even, graded = harmos(DECK, SHORT), harmos(DECK, {**SHORT, "bodies/shell/cells_grading": "[2.0, 1.0]"})
    check("mass", abs(graded.last("mass") / even.last("mass") - 1.0), 1e-12)
    check("kinetic energy", abs(graded.last("kinetic_energy") / even.last("kinetic_energy") - 1.0), 2e-3)
    first = [r["dt"][1] for r in (even, graded)]
    # ten cells, the last twice the first: the smallest is 0.690 of the mean
    check("first time step, against the smallest cell", abs(first[1] / first[0] / 0.690 - 1.0), 0.05)
    clean(even, graded)


# A rigid block with arcs once had the mass of its straight sides, and a rigid part of a file ended the program.
def test_rigid_blocks_weigh_what_their_cells_do():
    hard, corner, sides = "{eos: rigid, density: 1000.0}", 0.05 * sqrt(0.5), 40
    points = [s * corner for s in (-1.0, -1.0, 1.0, -1.0, 1.0, 1.0, -1.0, 1.0)]
    scene = {**SHORT, "materials/beryllium": hard, "boundaries": "{left: {type: outflow}, bottom: {type: outflow}}",
             "mesh": "{x: {from: -0.1, to: 0.1, cells: 40}, y: {from: -0.1, to: 0.1, cells: 40}}"}
    r = harmos(DECK, {**scene, "bodies/shell": f"{{material: beryllium, shape: polygon, points: {points}, cells: [10, 10], arc_radii: [0.05, 0.05, 0.05, 0.05], "
                                               "motion: free, angular_velocity: 100.0}"})
    area = 0.5 * sides * 0.05**2 * sin(2.0 * pi / sides)
    inertia = 0.5 * area * 0.05**2 * (1.0 - 2.0 / 3.0 * sin(pi / sides) ** 2)
    check("disc of four arcs: mass", abs(r.last("mass") / (1000.0 * area) - 1.0), 1e-12)
    check("its kinetic energy as it turns", abs(r.last("kinetic_energy") / (0.5 * 1000.0 * inertia * 100.0**2) - 1.0), 1e-12)
    clean(r)
    part = "{material: beryllium, shape: mesh part, part: shell, motion: free, velocity: [3.0, 0.0]}"
    r = from_file(ring("2.2"), {**SHORT, "materials/beryllium": hard}, part=part)
    area = 0.5 * ANGULAR * sin(0.5 * pi / ANGULAR) * (0.1**2 - 0.08**2)
    check("part of a file: mass", abs(r.last("mass") / (1000.0 * area) - 1.0), 1e-12)
    check("part of a file: momentum", abs(r.last("momentum_x") / (3000.0 * area) - 1.0), 1e-12)
    clean(r)


def refused(settings, words, text=None):
    r = from_file(text, settings, expect=2) if text else harmos(DECK, settings, expect=2)
    assert words in r.text, r.text
    print("  " + next(line for line in r.text.splitlines() if words in line))
    clean(r)


def test_what_cannot_be_meshed_is_refused_in_one_line():
    refused({"kinematics": "xfem"}, "arc_radii")
    refused({"bodies/shell/arc_radii": "[0.0, 0.05, 0.0, -0.08]"}, "cannot be an arc of radius 0.05")
    refused({"bodies/shell": PART}, "a mesh part needs kinematics lagrangian and mesh/file")
    refused(SHORT, "physical curve lower is no boundary", ring("2.2").replace('"bottom"', '"lower"'))
    refused(SHORT, '"shell" is no physical surface', ring("4.1").replace('"shell"', '"ring"'))
    refused({**SHORT, "geometry": "axisymmetric"}, "belongs to no physical curve left", ring("2.2").replace('1 2 "left"', '1 2 "top"'))
    refused({**SHORT, "mesh/file": "nowhere.msh", "bodies/shell": PART}, "nowhere.msh: cannot be read")


def test_a_mesh_that_folds_ends_the_run_with_its_place():
    # Spinning hard, a metal of no strength is thrown along its own mesh lines until a cell folds.
    weak = "{eos: stiffened, density: 1845.0, sound_speed: 8000.0}"
    body = ("{material: beryllium, shape: rectangle, center: [0.05, 0.05], size: [0.02, 0.02], angle: 20.0, "
            "angular_velocity: 1.0e5, velocity: [0.0, 0.0]}")
    r = harmos(DECK, {**QUIET, "materials/beryllium": weak, "bodies/shell": body, "run/end_time": 1.0e-3,
                      "numerics/subzonal_pressure": 0.0, "numerics/hourglass_viscosity": 0.0}, expect=3)
    line = next(line for line in r.text.splitlines() if "failed" in line)
    print(f"  {line}; t = {r.summary['end_time']:.3e} s")
    assert "cycle" in line and "material shell" in line and r.summary["status"] == "failed"
    clean(r)


if __name__ == "__main__":
    run(globals())
