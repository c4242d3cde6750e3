# SPDX-License-Identifier: BSD-3-Clause
"""Numerical inf-sup values of the multipliers (Chapelle & Bathe, Computers & Structures 47 (1993) 537-545).

For a straight interface between two materials that fill the unit square, with Harmos's own rows (program InterfaceRows):

    beta = min over q of max over v of  b(q, v) / (|q| |v|),   b(q, v) = integral of q n . (v_b - v_a) over the interface,
    |v|^2 = sum over pairs of (filled part of the cell) integral over the cell of (grad v : grad v + v . v),   |q|^2 = h integral of q^2,

that is, sqrt of the smallest eigenvalue of B K^-1 B^T q = mu h M q. The norm of v is that of Harmos's stiffness and mass, in which a pair has its volume fraction of its whole cell's;
h times L2 stands for the H^(-1/2) norm of the traction, as in Bechet, Moes & Wohlmuth, Int. J. Numer. Meth. Engng 78 (2009) 931-954. A value that stays where it is as h falls is a stable choice; one that falls
with h, or is zero, has tractions that no velocity feels.

inf_sup.py [--finest N] [--output FOLDER]: writes inf-sup.md and inf-sup.png.
"""
import argparse
import os
import pathlib
import subprocess

import numpy

from harness import ROOT, check

ROWS = os.environ.get("HARMOS_INTERFACE_ROWS", str(ROOT / "build/native/packages/constrain/InterfaceRows"))
PLACEMENTS = ["midpoint", "gauss points", "segment ends", "vital vertices", "mortar"]
MARKERS = {"midpoint": "o-", "gauss points": "s-", "segment ends": "v-", "vital vertices": "D--", "mortar": "^-"}
ANGLES = [0.0, 20.0, 35.0, 45.0]
OFFSETS = [0.0, 1e-3, 0.21, 0.37, 0.5]


def interface(cells, angle, offset, placement):
    """Layers of the dof nodes, pairs (fraction, four dofs), rows (length, normal, {dof: weight}, {group: share})."""
    text = subprocess.run([ROWS, str(cells), repr(angle), repr(offset), placement], check=True, stdout=subprocess.PIPE, text=True).stdout
    layer, pairs, rows = [], [], []
    for line in text.splitlines():
        kind, *item = line.split()
        if kind == "dof":
            layer.append(round(float(item[1]) * cells))
        elif kind == "pair":
            pairs.append((float(item[0]), [int(i) for i in item[1:]]))
        else:
            number = [float(i) for i in item]
            rows.append((number[0], number[1:3], list(zip(map(int, number[3:19:2]), number[4:19:2])), list(zip(map(int, number[19::2]), number[20::2]))))
    return numpy.array(layer), pairs, rows


def stiffness_and_mass(h):
    """Of a bilinear square, corners counter-clockwise."""
    gradient = numpy.array([[4, -1, -2, -1], [-1, 4, -1, -2], [-2, -1, 4, -1], [-1, -2, -1, 4]]) / 6.0
    mass = numpy.array([[4, 2, 1, 2], [2, 4, 2, 1], [1, 2, 4, 2], [2, 1, 2, 4]]) / 36.0
    return gradient + h * h * mass


def solve_by_layers(pairs, element, layer, right):
    """norm^-1 right by block elimination: the dofs of a layer of nodes couple to those of the next layers alone."""
    order = numpy.argsort(layer, kind="stable")
    begin = numpy.searchsorted(layer[order], range(layer.max() + 2))
    place = numpy.empty_like(order)
    for k in range(layer.max() + 1):
        place[order[begin[k]:begin[k + 1]]] = range(begin[k + 1] - begin[k])
    size = numpy.diff(begin)
    diagonal = [numpy.zeros((m, m)) for m in size]
    below = [numpy.zeros((size[k + 1], size[k])) for k in range(len(size) - 1)]
    for fraction, corner in pairs:
        for i, a in enumerate(corner):
            for j, b in enumerate(corner):
                if layer[a] == layer[b]:
                    diagonal[layer[a]][place[a], place[b]] += fraction * element[i, j]
                elif layer[a] > layer[b]:
                    below[layer[b]][place[a], place[b]] += fraction * element[i, j]
    x = [right[order[begin[k]:begin[k + 1]]] for k in range(len(size))]
    for k, lower in enumerate(below):
        reduced = numpy.linalg.solve(diagonal[k], numpy.hstack([lower.T, x[k]]))
        diagonal[k + 1] -= lower @ reduced[:, :len(lower)]
        x[k + 1] = x[k + 1] - lower @ reduced[:, len(lower):]
    for k in reversed(range(len(size))):
        x[k] = numpy.linalg.solve(diagonal[k], x[k] - (below[k].T @ x[k + 1] if k < len(below) else 0.0))
    result = numpy.empty_like(right)
    result[order] = numpy.vstack(x)
    return result


def inf_sup(cells, angle, offset, placement):
    """beta, and the number of multipliers."""
    h = 1.0 / cells
    layer, pairs, rows = interface(cells, angle, offset, placement)
    groups = 1 + max(g for row in rows for g, _ in row[3])
    length = numpy.array([row[0] for row in rows])
    impulse = numpy.zeros((len(rows), groups))  # of the rows by impulses of the groups
    trace = numpy.zeros((2, len(layer), len(rows)))
    for i, (_, normal, weights, shares) in enumerate(rows):
        for dof, weight in weights:
            for d in range(2):
                trace[d, dof, i] += weight * normal[d]
        for group, share in shares:
            impulse[i, group] += share
    b = numpy.hstack([t @ impulse for t in trace])
    product = b.T @ solve_by_layers(pairs, stiffness_and_mass(h), layer, b)
    schur = product[:groups, :groups] + product[groups:, groups:]
    size, vector = numpy.linalg.eigh(h * impulse.T @ (impulse / length[:, None]))  # of tractions: impulse over length
    felt = size > 1e-10 * size[-1]  # groups whose impulses cancel in every row are no traction
    scaled = vector[:, felt] / numpy.sqrt(size[felt])
    return float(numpy.sqrt(max(numpy.linalg.eigvalsh(scaled.T @ schur @ scaled)[0], 0.0))), int(felt.sum())


def measure(finest):
    """By placement and number of cells: the least beta over angles and offsets, and where it is."""
    found, cells = {}, [n for n in (8, 16, 32, 64) if n <= finest]
    for placement in PLACEMENTS:
        found[placement] = {}
        for n in cells:
            found[placement][n] = {angle: min(inf_sup(n, angle, offset, placement)[0] for offset in OFFSETS) for angle in ANGLES}
        print(placement, {n: f"{min(v.values()):.2e}" for n, v in found[placement].items()}, flush=True)
    return found


def table(found):
    cells = list(next(iter(found.values())))
    """Least values over offsets, at the angles."""
    lines = ["| placement | " + " | ".join(f"{n} cells" for n in cells) + " |", "| --- " * (len(cells) + 1) + "|"]
    for placement, by_cells in found.items():
        entries = [", ".join(f"{by_cells[n][angle]:.2g}" for angle in ANGLES) for n in cells]
        lines.append(f"| {placement} | " + " | ".join(entries) + " |")
    return "\n".join(lines) + "\n"


def chart(found, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.ticker import NullFormatter
    figure, all_axes = plt.subplots(1, len(ANGLES), figsize=(13, 3.8), sharey=True)
    nothing = 1e-6
    for angle, axes in zip(ANGLES, all_axes):
        for placement, by_cells in found.items():
            axes.loglog(list(by_cells), [max(v[angle], nothing) for v in by_cells.values()], MARKERS[placement], label=placement)
        axes.set_title(f"{angle:.0f} degrees")
        axes.set_xlabel("cells")
        axes.set_xticks(list(by_cells), [str(n) for n in by_cells])
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.grid(True, which="major", alpha=0.4)
    all_axes[0].set_ylabel(f"inf-sup value, least over offsets\n({nothing:.0e}: none)")
    all_axes[-1].legend(fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5))
    figure.tight_layout()
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--finest", type=int, default=64)
    parser.add_argument("--output", default=str(ROOT / "results/inf_sup"))
    arguments = parser.parse_args()
    folder = pathlib.Path(arguments.output)
    folder.mkdir(parents=True, exist_ok=True)
    values = measure(arguments.finest)
    (folder / "inf-sup.md").write_text(table(values))
    chart(values, folder / "inf-sup.png")
    print("written to", folder)
    for angle in ANGLES:
        by_cells = [v[angle] for v in values["mortar"].values()]
        check(f"mortar, {angle:.0f} degrees: fall of the inf-sup value from the coarsest mesh to the finest", 1.0 - by_cells[-1] / by_cells[0], 0.1)
