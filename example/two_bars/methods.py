# SPDX-License-Identifier: BSD-3-Clause
"""methods.py HARMOS RESULTS: the contact stress of two bars by multipliers, penalties and Nitsche's method beside the exact one
(the problem of Carpenter, Taylor & Katona, Int. J. Numer. Meth. Engng 32 (1991) 103), for two places of the interface in its cell."""
import csv
import pathlib
import subprocess
import sys
from math import sqrt

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

METHODS = {"multipliers": "{}", "penalty 0.3": "{method: penalty, penalty: 0.3}", "penalty 1": "{method: penalty, penalty: 1.0}", "Nitsche": "{method: nitsche}"}
PLACES = {"interface on a cell face": 0.0, "at 0.3 of a cell": 0.3}
HEIGHT, V, L, RHO = 0.0125, 10.0, 1.0, 7800.0
C = sqrt(4600.0**2 + 4.0 * 80.0e9 / (3.0 * RHO))

program, results = sys.argv[1], pathlib.Path(sys.argv[2])
figure, axes = plt.subplots(len(METHODS), len(PLACES), figsize=(10, 9), sharex=True, squeeze=False)
for column, (place, part) in enumerate(PLACES.items()):
    x = part * 0.0125
    for row, (name, constraint) in enumerate(METHODS.items()):
        folder = results / f"{name.replace(' ', '_')}_{part}"
        subprocess.run([program, "run", "deck.yaml", "--output", folder, "--force", "--set", f"numerics/constraint={constraint}", "--set", "output/fields/every_time=0.0",
                        "--set", f"bodies/left/center=[{x - 0.5}, 0.0]", "--set", f"bodies/right/center=[{x + 0.5}, 0.0]"], check=True, stdout=subprocess.DEVNULL)
        with open(folder / "contact.csv", newline="") as file:
            rows = [(float(r["time"]), abs(float(r["force_x"])) / HEIGHT) for r in csv.DictReader(file) if {r["a"], r["b"]} == {"left", "right"}]
        plot = axes[row][column]
        plot.plot([t * C / L for t, _ in rows], [s / (0.5 * RHO * C * V) for _, s in rows], ".-", markersize=2, linewidth=0.6, label=name)
        plot.plot([0.0, 0.0, 2.0, 2.0, 2.6], [0.0, 1.0, 1.0, 0.0, 0.0], "k--", linewidth=1.0, label="exact")
        plot.set_ylim(-0.1, 2.1)
        plot.set_xlim(-0.05, 2.6)
        plot.legend(loc="upper right", fontsize=8)
        if row == 0:
            plot.set_title(place)
        if column == 0:
            plot.set_ylabel("stress / (rho c V / 2)")
    axes[-1][column].set_xlabel("t c / L")
figure.tight_layout()
figure.savefig(results / "methods.png", dpi=110)
