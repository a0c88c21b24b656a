#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The surfaces that a structured scan saw, as an OBJ: the same scene for another instrument, which stands at 0,0,0 there.
Points between two sides are given to the nearer side, and what the front hides of the back is taken to go on. Needs numpy.

usage: scene_of_scan.py SCAN.ptx SCENE.obj     (of one scan; `standpoint import SCENE.obj -o P --up z`,
       `standpoint station P --add S1 --at 0,0,0 --stand free`)
"""
import sys

import numpy as np

FROM_SIDE_M, STEP_M = 0.02, 0.04


def read(name):
    with open(name) as file:
        columns, rows = int(file.readline()), int(file.readline())
        for _ in range(8):
            file.readline()
        points = np.array([line.split()[:3] for line in file], float).reshape(columns, rows, 3)
    return points, np.any(points != 0, axis=2)


def filled(angles):
    known = ~np.isnan(angles)
    places = np.arange(len(angles))
    return np.interp(places, places[known], angles[known])


def without_mixed(ranges):
    for axis in (1, 0, 1, 0):
        before, after = np.roll(ranges, 1, axis), np.roll(ranges, -1, axis)
        near, far = np.fmin(before, after), np.fmax(before, after)
        mixed = (ranges - near > FROM_SIDE_M) & (far - ranges > FROM_SIDE_M)
        ranges = np.where(mixed, np.where(ranges - near < far - ranges, near, far), ranges)
    return ranges


class Quads:
    def __init__(self, file):
        self.file, self.corners = file, 0

    def add(self, azimuths, elevations, ranges):
        for (i, k), r in zip(((0, 0), (1, 0), (1, 1), (0, 1)), ranges):
            a, e = azimuths[i], elevations[k]
            self.file.write(f"v {r * np.cos(e) * np.cos(a):.5f} {r * np.cos(e) * np.sin(a):.5f} {r * np.sin(e):.5f}\n")
        self.file.write("f " + " ".join(str(self.corners + n) for n in (1, 2, 3, 4)) + "\n")
        self.corners += 4


def write(name, azimuth, elevation, ranges):
    with open(name, "w") as file:
        quads = Quads(file)
        for c in range(ranges.shape[0] - 1):
            for r in range(ranges.shape[1] - 1):
                cell = ranges[c:c + 2, r:r + 2]
                if np.isnan(cell).any():
                    continue
                a, e = azimuth[c:c + 2], elevation[r:r + 2]
                far = cell.max()
                if far - cell.min() < STEP_M:
                    quads.add(a, e, (cell[0, 0], cell[1, 0], cell[1, 1], cell[0, 1]))
                    continue
                quads.add(a, e, (far,) * 4)
                halves = [np.array([(x[0], x.mean()), (x.mean(), x[1])]) for x in (a, e)]
                for i in (0, 1):
                    for k in (0, 1):
                        if far - cell[i, k] >= STEP_M:
                            quads.add(halves[0][i], halves[1][k], (cell[i, k],) * 4)


points, there = read(sys.argv[1])
ranges = np.where(there, np.linalg.norm(points, axis=2), np.nan)
with np.errstate(invalid="ignore"):
    azimuths = np.where(there, np.arctan2(points[..., 1], points[..., 0]), np.nan)
    elevations = np.where(there, np.arcsin(points[..., 2] / ranges), np.nan)
write(sys.argv[2], filled(np.nanmedian(azimuths, axis=1)), filled(np.nanmedian(elevations, axis=0)), without_mixed(ranges))
