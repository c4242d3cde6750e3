#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measure a shot on a Whipple shield in its results folder: hole in the bumper, debris cloud, hole in the rear wall.

A row of cells of height dz that a plate fills outside of a hole of radius a holds the volume dz (R^2 - a^2) / 2 per
radian, R the mesh's radius: the hole's diameter in each row of the plate follows from the volume of its material there.
Maiden & McMillan, AIAA J. 2 (1964) 1992: hole of an aluminium sphere (d) in an aluminium sheet (t) at V km/s,
D / d = 0.45 V (t / d)^(2/3) + 0.9.
"""
import csv
import glob
import os
import sys

import h5py
import numpy


class Frame:
    """Volumes and masses of materials in the cells of one fields file (rectilinear mesh)."""

    def __init__(self, path):
        with h5py.File(path) as file:
            self.time = float(file.attrs["time"])
            self.names = file["materials"][()].decode().split()
            corners = file["nodes/position"][()][file["cells/connectivity"][()].astype(int)]
            self.cell = file["pairs/cell"][()].astype(int)
            self.material = file["pairs/material"][()].astype(int)
            self.fraction = file["pairs/volume_fraction"][()]
            density = file["pairs/density"][()]
        self.low, self.high = corners.min(axis=1), corners.max(axis=1)
        self.middle = 0.5 * (self.low + self.high)
        self.ring = 0.5 * (self.high[:, 0] ** 2 - self.low[:, 0] ** 2)  # per height and radian
        self.radius = self.high[:, 0].max()
        self.mass = density * self.fraction * (self.ring * (self.high[:, 1] - self.low[:, 1]))[self.cell]  # per radian

    def part(self, name):
        """Rows of the pairs of a material."""
        return numpy.flatnonzero(self.material == self.names.index(name))


def holeDiameters(frame, plate, bottom, top, least_radius):
    """Of each row of cells between bottom and top; material within least_radius, the debris, does not count."""
    rows = frame.part(plate)
    cell = frame.cell[rows]
    diameters = []
    for z in numpy.unique(numpy.round(frame.middle[:, 1], 12)):
        if not bottom < z < top:
            continue
        here = (abs(frame.middle[cell, 1] - z) < 1e-9) & (frame.middle[cell, 0] > least_radius)
        plate_ring = (frame.fraction[rows[here]] * frame.ring[cell[here]]).sum()
        diameters.append(2.0 * numpy.sqrt(max(frame.radius**2 - 2.0 * plate_ring, 0.0)))
    return diameters


def leastThickness(frame, wall, within):
    """Of a wall along the axis, over the columns of cells within a radius: what is left where it is thinnest."""
    rows = frame.part(wall)
    cell = frame.cell[rows]
    thickness = []
    for r in numpy.unique(numpy.round(frame.middle[:, 0], 12)):
        if r < within:
            here = abs(frame.middle[cell, 0] - r) < 1e-9
            height = frame.high[cell[here], 1] - frame.low[cell[here], 1]
            thickness.append((frame.fraction[rows[here]] * height).sum())
    return min(thickness)


def volumeBeyond(frame, name, z):
    """Volume of a material above z [m^3 per radian]."""
    rows = frame.part(name)
    cell = frame.cell[rows]
    beyond = frame.middle[cell, 1] > z
    height = frame.high[cell, 1] - frame.low[cell, 1]
    return (frame.fraction[rows] * frame.ring[cell] * height)[beyond].sum()


def massFront(frame, names, mass):
    """Height above which lies that mass [kg per radian] of the materials, to half a cell."""
    rows = numpy.concatenate([frame.part(name) for name in names])
    height = frame.middle[frame.cell[rows], 1]
    down = numpy.argsort(-height)
    return height[down][numpy.searchsorted(numpy.cumsum(frame.mass[rows][down]), mass)]


def frames(directory):
    return [Frame(path) for path in sorted(glob.glob(os.path.join(directory, "fields_*.h5")))]


def history(directory):
    with open(os.path.join(directory, "history.csv"), newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {key: numpy.array([float(row[key]) for row in rows]) for key in rows[0]}


def frontSpeeds(columns, gap):
    """Axial speed of the debris cloud's front, and its radial speed, while the front crosses the middle of the gap."""
    front = numpy.maximum(columns["sphere.y_max"], columns["bumper.y_max"])
    flight = (front > 0.2 * gap) & (front < 0.8 * gap)
    time = columns["time"][flight]
    return numpy.polyfit(time, front[flight], 1)[0], numpy.polyfit(time, columns["sphere.x_max"][flight], 1)[0]


def massFrontSpeed(shot, gap, mass):
    """Speed of massFront of sphere and bumper while it crosses the middle of the gap; `shot` are the frames of a run."""
    front = numpy.array([(frame.time, massFront(frame, ("sphere", "bumper"), mass)) for frame in shot])
    flight = front[(front[:, 1] > 0.2 * gap) & (front[:, 1] < 0.8 * gap)]
    return numpy.polyfit(flight[:, 0], flight[:, 1], 1)[0]


def maidenAndMcMillan(diameter, thickness, speed):
    """Diameter of the hole; speed in m/s."""
    return diameter * (0.45e-3 * speed * (thickness / diameter) ** (2.0 / 3.0) + 0.9)


def main():
    diameter, thickness, speed, gap, wall = 9.53e-3, 2.0e-3, 6700.0, 48.0e-3, 4.0e-3
    directory = sys.argv[1]
    axial, radial = frontSpeeds(history(directory), gap)
    print(f"debris front: {1e-3 * axial:.2f} km/s along the axis ({axial / speed:.2f} V), sphere's debris {1e-3 * radial:.2f} km/s outwards")
    shot = frames(directory)
    sphere = shot[0].mass[shot[0].part("sphere")].sum()
    heavy = massFrontSpeed(shot, gap, 1e-3 * sphere)
    print(f"front that holds a thousandth of the sphere's mass: {1e-3 * heavy:.2f} km/s ({heavy / speed:.2f} V)")
    for frame in shot:
        holes = holeDiameters(frame, "bumper", 0.0, thickness, 0.4 * diameter)
        left = leastThickness(frame, "rear", diameter)
        print(f"{1e6 * frame.time:5.1f} us: hole in the bumper {1e3 * min(holes):.2f} mm (narrowest of {len(holes)} rows; mean {1e3 * numpy.mean(holes):.2f}), "
              f"wall left {1e3 * left:.2f} of {1e3 * wall:.2f} mm where thinnest")
    exact = maidenAndMcMillan(diameter, thickness, speed)
    print(f"Maiden and McMillan: {1e3 * exact:.2f} mm, found {100.0 * (min(holes) / exact - 1.0):+.1f}%")


if __name__ == "__main__":
    main()
