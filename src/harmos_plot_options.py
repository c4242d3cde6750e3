# SPDX-License-Identifier: BSD-3-Clause
"""Options of harmos-plot: what they are, and what is refused before anything is read."""

import argparse
import math
import os
import re
import sys

LEAST_DPI, MOST_DPI = 10, 1200


class PlotError(Exception):
    """What the user can mend: printed as one line."""


def parseArguments(fields, extensions):
    """The command line. fields: names of what can be drawn; extensions: of pictures, without their dot."""
    parser = argparse.ArgumentParser(
        prog="harmos-plot", description="Draw the results of a Harmos run: materials with their true interfaces, any "
        "field, histories and films. Without options: the materials at the last output.")
    parser.add_argument("directory", metavar="DIR", help="results folder of a run")
    parser.add_argument("--compare", action="append", default=[], metavar="DIR2", help="another run, drawn beside the "
                        "first; may be given several times")
    parser.add_argument("--overlay", metavar="DIR3", help="draw the body-fitted mesh of this run, at the nearest time, "
                        "in black over the picture")
    parser.add_argument("--labels", nargs="+", metavar="NAME", help="titles of the runs")
    parser.add_argument("--field", choices=["material", *fields], help="what to draw (material)")
    parser.add_argument("--time", type=float, metavar="T", help="the output nearest to this time [s]")
    parser.add_argument("--frame", type=int, metavar="K", help="output number, from 0; negative: from the end")
    parser.add_argument("--all", action="store_true", help="a picture of every output")
    parser.add_argument("--history", nargs="*", metavar="COLUMN", help="draw columns of history.csv over time (none "
                        "named: momentum, energies, losses, iterations)")
    parser.add_argument("--film", metavar="FILE", help="a film of all outputs: .gif, or .mp4 with ffmpeg")
    parser.add_argument("-o", "--output", metavar="FILE", help="picture (DIR/FIELD.png, DIR/history.png)")
    parser.add_argument("--range", nargs=2, type=float, metavar=("LOW", "HIGH"), help="of the colours [SI]")
    parser.add_argument("--window", nargs=4, type=float, metavar=("X0", "X1", "Y0", "Y1"), help="part to draw [m]")
    parser.add_argument("--grey", nargs="+", default=[], metavar="NAME", help="materials drawn grey in any field")
    parser.add_argument("--outline", type=float, metavar="T", help="also the interfaces at this time, dashed [s]")
    parser.add_argument("--mesh", action="store_true", help="draw the mesh lines")
    parser.add_argument("--mirror", action="store_true", help="draw the image on the other side of x = 0 as well")
    parser.add_argument("--no-interface", action="store_true", help="leave the interface lines out")
    parser.add_argument("--thinnest", type=float, default=1e-4, metavar="PART", help="regions that fill less than this "
                        "part of their cell are not drawn and do not count for the range of the colours (1e-4): films "
                        "that a contact leaves would be lines; 0 draws all")
    parser.add_argument("--fps", type=int, default=12, help="pictures a second of a film (12)")
    parser.add_argument("--dpi", type=int, default=150, help="dots an inch (150)")
    # argparse takes -2e7 for an option, but not with a space before it.
    options = parser.parse_args([re.sub(r"^(?=-[\d.]+e)", " ", word, flags=re.I) for word in sys.argv[1:]])
    checkNumbers(options)
    checkChoices(options)
    extension = os.path.splitext(options.output or "")[1].lower()
    if extension and extension[1:] not in extensions:
        raise PlotError(f"-o {options.output}: no such kind of picture; there are {', '.join(sorted(extensions))}")
    return options


def checkNumbers(options):
    for name, numbers in (("time", [options.time]), ("outline", [options.outline]), ("thinnest", [options.thinnest]),
                          ("range", options.range or []), ("window", options.window or [])):
        if any(number is not None and not math.isfinite(number) for number in numbers):
            raise PlotError(f"--{name} {' '.join(map(str, numbers))}: expected: finite numbers")
    if options.range and not options.range[0] < options.range[1]:
        raise PlotError(f"--range {options.range[0]:g} {options.range[1]:g}: expected: LOW below HIGH")
    if options.window and not (options.window[0] < options.window[1] and options.window[2] < options.window[3]):
        raise PlotError(f"--window {' '.join(f'{x:g}' for x in options.window)}: expected: X0 below X1, Y0 below Y1")
    if options.fps < 1:
        raise PlotError(f"--fps {options.fps}: expected: at least 1")
    if not LEAST_DPI <= options.dpi <= MOST_DPI:
        raise PlotError(f"--dpi {options.dpi}: expected: {LEAST_DPI} to {MOST_DPI}")


def checkChoices(options):
    """Of two options that cannot both be followed, none would be passed over in silence."""
    given = {"--time": options.time is not None, "--frame": options.frame is not None, "--all": options.all,
             "--film": options.film is not None}
    chosen = [name for name, is_given in given.items() if is_given]
    if len(chosen) > 1:
        raise PlotError(f"{chosen[0]} beside {chosen[1]}: which outputs? expected: one of {', '.join(given)}")
    if options.output and options.film and options.history is None:
        raise PlotError("-o beside --film: the film has its own file; expected: one of them")
    if options.output and options.field and options.history is not None:
        raise PlotError("-o beside --history and --field: two pictures; expected: one after the other")
    if options.labels and len(options.labels) != 1 + len(options.compare):
        raise PlotError(f"--labels: {len(options.labels)} names; expected: one for DIR and one for each --compare")
