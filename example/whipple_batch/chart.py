#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""chart.py RESULTS PICTURE: every shot with a result by speed and by its size over the critical one of the ballistic limit equation.

Full markers: perforated in the experiment; red where Harmos differs from it. The equation says that what is above one
perforates.
"""
import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import batch


def main(results, picture):
    figure, axes = plt.subplots(figsize=(9.0, 4.4), constrained_layout=True)
    for shot in batch.readShots(batch.HERE / "data/whipple-normal-aluminium.csv"):
        done = pathlib.Path(results) / shot["id"] / "result.json"
        if not done.exists():
            continue
        found = json.loads(done.read_text(encoding="utf-8"))["perforated"]
        colour = "#3B7D3A" if found == shot["perforated"] else "#C8321B"
        axes.plot(1e-3 * shot["speed"], shot["d"] / batch.criticalDiameter(shot), "o" if found else "s", ms=7, mew=1.6, color=colour,
                  mfc=colour if shot["perforated"] else "none")
    for label, style in (("perforated in the experiment", dict(marker="o", mfc="#444444")), ("not perforated", dict(marker="o", mfc="none")),
                         ("Harmos: perforated", dict(marker="o", mfc="none")), ("Harmos: not perforated", dict(marker="s", mfc="none"))):
        axes.plot([], [], ls="", color="#444444", ms=7, mew=1.6, label=label, **style)
    axes.plot([], [], "o", color="#3B7D3A", label="Harmos agrees with the experiment")
    axes.plot([], [], "o", color="#C8321B", label="Harmos differs")
    axes.axhline(1.0, color="#777777", lw=1.0, ls="--")
    axes.text(0.15, 1.03, "ballistic limit equation", color="#777777", fontsize=8, va="bottom")
    axes.set(xlabel="speed [km/s]", ylabel="diameter over the critical one", yscale="log", xlim=(0.0, 9.2))
    axes.set_yticks([0.1, 0.2, 0.5, 1.0, 2.0, 5.0], ["0.1", "0.2", "0.5", "1", "2", "5"])
    axes.legend(fontsize=7.5, loc="upper left", bbox_to_anchor=(1.01, 1.0))
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(*sys.argv[1:])
