#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Write sphere.msh: quadrilaterals of a half disc about the axis, a core block in two wings, for the body-fitted run.

The core is a square (rounded by half) with 2 n by n cells; between it and the circle lie three blocks of n rings.
Use: make_sphere.py RADIUS CENTRE_Z N > sphere.msh
"""
import sys
from math import cos, pi, sin, sqrt


def corePoint(u, v, radius):
    """(u, v) in [0, 1] x [-1, 1] to a square of half side 0.5 radius, its sides rounded half way to their circle."""
    x, y = 0.5 * u, 0.5 * v
    reach = max(abs(x), abs(y))
    distance = sqrt(x * x + y * y)
    stretch = 1.0 if distance == 0.0 else 1.0 + 0.4 * (reach / distance * 1.17 - 1.0) * reach / 0.5
    return radius * x * stretch, radius * y * stretch


def sphere(radius, centre, n):
    """Nodes and quadrilaterals (counter-clockwise, numbered from 1)."""
    nodes, number, quads = [], {}, []

    def node(x, z):
        x = 0.0 if abs(x) < 1e-9 * radius else x
        key = (round(x / radius, 9), round(z / radius, 9))
        if key not in number:
            nodes.append((x, centre + z))
            number[key] = len(nodes)
        return number[key]

    def fill(columns, rows, point):
        for i in range(columns):
            for j in range(rows):
                corners = [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)]
                quads.append([node(*c) for c in corners])

    fill(n, 2 * n, lambda i, j: corePoint(i / n, j / n - 1.0, radius))
    # around: the core's boundary from the lower to the upper point of the axis, 4 n edges
    rim = [(i / n, -1.0) for i in range(n)] + [(1.0, j / n - 1.0) for j in range(2 * n)] + [(1.0 - i / n, 1.0) for i in range(n + 1)]

    def ring(i, j):
        angle = -0.5 * pi + pi * j / (4 * n)
        x, z = corePoint(*rim[j], radius)
        s = i / n
        return (1.0 - s) * x + s * radius * cos(angle), (1.0 - s) * z + s * radius * sin(angle)

    fill(n, 4 * n, ring)
    return nodes, quads


def main():
    if len(sys.argv) != 4:
        sys.exit("make_sphere.py RADIUS CENTRE_Z N: radius and height of the centre in metres, cells from centre to core")
    nodes, quads = sphere(float(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3]))
    axis = [(q[k], q[(k + 1) % 4]) for q in quads for k in range(4) if nodes[q[k] - 1][0] == nodes[q[(k + 1) % 4] - 1][0] == 0.0]
    print('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 "left"\n2 2 "sphere"\n$EndPhysicalNames')
    print(f"$Nodes\n{len(nodes)}")
    for k, (x, z) in enumerate(nodes):
        print(f"{k + 1} {x:.10g} {z:.10g} 0")
    print(f"$EndNodes\n$Elements\n{len(axis) + len(quads)}")
    for k, edge in enumerate(axis):
        print(f"{k + 1} 1 2 1 1 {edge[0]} {edge[1]}")
    for k, quad in enumerate(quads):
        print(f"{len(axis) + k + 1} 3 2 2 1 {' '.join(map(str, quad))}")
    print("$EndElements")


if __name__ == "__main__":
    main()
