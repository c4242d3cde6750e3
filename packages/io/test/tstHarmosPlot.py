# SPDX-License-Identifier: BSD-3-Clause
"""harmos-plot on the folder that tstFieldOutput wrote. Usage: tstHarmosPlot.py HARMOS_PLOT RUN_FOLDER OUTPUT_FOLDER"""

import json
import os
import re
import shutil
import subprocess
import sys
import unittest
import unittest.mock
import xml.etree.ElementTree as xml

try:
    import h5py
    import numpy
    from PIL import Image
except ImportError as error:
    sys.exit(f"tstHarmosPlot: {error}; on Debian: apt install python3-matplotlib python3-h5py python3-pil")

PLOT, RUN, OUT = sys.argv[1:4]
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(PLOT))
import harmos_plot_options as options  # noqa: E402


def plot(*arguments):
    return subprocess.run([sys.executable, PLOT, *arguments], capture_output=True, text=True, check=False)


class HarmosPlot(unittest.TestCase):
    def picture(self, *arguments):
        path = os.path.join(OUT, "plot.png")
        if os.path.exists(path):
            os.remove(path)
        result = plot(*arguments, "-o", path, "--dpi", "60")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout.strip(), path)
        with Image.open(path) as image:
            return numpy.asarray(image.convert("RGB"))

    def test_materials_areDrawnInTheirColoursInTheRightShares(self):
        pixels = self.picture(RUN, "--no-interface").reshape(-1, 3).astype(int)
        share = [(abs(pixels - colour).sum(axis=1) < 6).sum() for colour in ([0x4C, 0x78, 0xA8], [0xE3, 0x9C, 0x37])]
        self.assertAlmostEqual(share[0] / share[1], 2.25 / 1.5, delta=0.05)  # areas 4.5 and 3

    def test_fields_areDrawnWithAColourBar(self):
        for field in ("pressure", "velocity", "deviator_xy"):  # a scalar, a length, a component
            self.assertGreater(len(numpy.unique(self.picture(RUN, "--field", field).reshape(-1, 3), axis=0)), 20, field)

    def test_negativeNumbers_areNoOptions(self):
        limits = self.picture(RUN, "--field", "pressure", "--range", "-2e7", "2e7", "--window", "-1e-1", "0.5", "-.1", "0.5")
        self.assertTrue((limits == self.picture(RUN, "--field", "pressure", "--range", "-20000000.0", "20000000.0", "--window", "-0.1", "0.5", "-0.1", "0.5")).all())

    def test_greyMaterial_isGreyAndLeavesTheColourRangeAlone(self):
        pixels = self.picture(RUN, "--field", "pressure", "--grey", "copper", "--outline", "0", "--no-interface")
        grey = (abs(pixels.reshape(-1, 3).astype(int) - [0xB9, 0xBC, 0xC0]).sum(axis=1) < 6).sum()
        self.assertGreater(grey, 0.1 * pixels[..., 0].size)

    def test_comparison_isWiderOrTallerThanOnePanel(self):
        one, two = self.picture(RUN), self.picture(RUN, "--compare", RUN, "--labels", "xfem", "single")
        self.assertGreater(two.size, 1.5 * one.size)
        self.assertGreater(self.picture(RUN, "--compare", RUN, "--compare", RUN).size, 1.3 * two.size)

    def test_historyColumns_areDrawn(self):
        self.picture(RUN, "--history", "kinetic_energy", "copper.mass")

    def test_unitsOfTheHistory_arePerRadianAboutAnAxis(self):
        """The labels, which an SVG file has as comments."""
        copy = os.path.join(OUT, "axisymmetric")
        shutil.rmtree(copy, ignore_errors=True)
        shutil.copytree(RUN, copy)
        path = os.path.join(OUT, "history.svg")
        for folder, units in ((RUN, ("kg/m", "J/m", "m²")), (copy, ("kg", "J", "m³"))):
            if folder == copy:
                for name in os.listdir(copy):
                    if name.startswith("fields_0") and name.endswith(".h5"):
                        with h5py.File(os.path.join(copy, name), "r+") as file:
                            file.attrs["axisymmetric"] = 1
            result = plot(folder, "--history", "mass", "kinetic_energy", "copper.volume", "-o", path)
            self.assertEqual(result.returncode, 0, result.stderr)
            with open(path, encoding="utf-8") as file:
                labels = re.findall(r"\[([^\]]+)\] -->", file.read())
            self.assertEqual([unit for unit in units if not any(label.endswith(unit) for label in labels)], [], labels)

    def test_film_hasAPictureForEveryOutput(self):
        path = os.path.join(OUT, "film.gif")
        self.assertEqual(plot(RUN, "--film", path, "--field", "velocity", "--dpi", "50").returncode, 0)
        with Image.open(path) as film:
            self.assertGreaterEqual(film.n_frames, 1)
            self.assertEqual(film.format, "GIF")

    def test_mistakes_areOneClearLine(self):
        for arguments, words in (([OUT + "/none"], "no such folder"),
                                 ([RUN, "--history", "speed"], "no column 'speed'"),
                                 ([RUN, "--frame", "7"], "there are 3 frames"),
                                 ([RUN, "--field", "damage"], "no law of the deck can fail"),
                                 ([RUN, "--film", "a.avi"], ".gif or .mp4"),
                                 ([RUN, "--window", "50", "60", "0", "1"], "nothing is there; the mesh reaches from"),
                                 ([RUN, *(["--compare", RUN] * 9), "--dpi", "1200"], "pixels across"),
                                 ([RUN, "-o", "a.foo"], "no such kind of picture; there are"),
                                 ([RUN, "--grey", "lead"], "no such material; there are")):
            result = plot(*arguments)
            self.assertEqual(result.returncode, 2, words)
            self.assertIn(words, result.stderr)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)

    def test_optionsThatCannotBeFollowed_areRefused(self):
        for arguments, words in ((["--film", "a.gif", "--fps", "0"], "--fps 0: expected: at least 1"),
                                 (["--film", "a.gif", "-o", "a.png"], "-o beside --film"),
                                 (["--film", "a.gif", "--all"], "--all beside --film"),
                                 (["--history", "--field", "pressure", "-o", "a.png"], "-o beside --history and --field"),
                                 (["--frame", "1", "--time", "2"], "--time beside --frame"),
                                 (["--window", "1", "0", "0", "1"], "X0 below X1"),
                                 (["--dpi", "0"], "--dpi 0: expected: 10 to 1200"),
                                 (["--dpi", "100000"], "--dpi 100000: expected: 10 to 1200"),
                                 (["--field", "pressure", "--range", "5", "1"], "LOW below HIGH"),
                                 (["--field", "pressure", "--range", "nan", "nan"], "--range nan nan: expected: finite"),
                                 (["--time", "nan"], "--time nan: expected: finite"),
                                 (["--outline", "nan"], "--outline nan: expected: finite")):
            with unittest.mock.patch("sys.argv", ["harmos-plot", RUN, *arguments]):
                with self.assertRaises(options.PlotError) as refusal:
                    options.parseArguments(["pressure"], ["png"])
            self.assertIn(words, str(refusal.exception))


class Files(unittest.TestCase):
    def test_xdmf_isWellFormedAndItsShapesAreThoseOfTheArrays(self):
        root = xml.parse(os.path.join(RUN, "fields.xdmf")).getroot()
        self.assertEqual([float(time.get("Value")) for time in root.iter("Time")], [0.0, 1e-6, 2e-6])
        items = list(root.iter("DataItem"))
        self.assertEqual(len(items), 3 * (2 + 5 + 2 + 9 + 2 + 2))
        for item in items:
            name, path = item.text.split(":")
            with h5py.File(os.path.join(RUN, name), "r") as file:
                shape = tuple(int(n) for n in item.get("Dimensions").split())
                self.assertEqual(file[path].shape, shape, item.text)
                self.assertEqual(file[path].dtype.itemsize, int(item.get("Precision")), item.text)
                self.assertEqual(file[path].dtype.kind, {"Int": "i", "Float": "f"}[item.get("NumberType")], item.text)

    def test_vtu_isWellFormedAndListedByThePvd(self):
        for entry in xml.parse(os.path.join(RUN, "fields.pvd")).getroot().iter("DataSet"):
            piece = xml.parse(os.path.join(RUN, entry.get("file"))).getroot().find(".//Piece")
            self.assertEqual(int(piece.get("NumberOfCells")), 10)
            self.assertEqual(int(piece.get("NumberOfPoints")), 40)

    def test_summary_isJson(self):
        path = os.path.join(os.path.dirname(RUN), "summary.json")
        if not os.path.exists(path):
            self.fail(f"{path} is missing: run tstHistory first")
        with open(path, encoding="utf-8") as file:
            summary = json.load(file)
        self.assertEqual(summary["deck"]["mesh"]["cells"], [8, 4])
        self.assertEqual(summary["phases"]["remap"], 1.5)


if __name__ == "__main__":
    os.makedirs(OUT, exist_ok=True)
    unittest.main(argv=sys.argv[:1])
