#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What makes points look real, measured in the same way on structured scans, a real one and ours: noise on flat windows,
points between the two sides of a depth edge, and how the stored intensity varies on flat windows. Needs numpy.

usage: fidelity.py SCAN.ptx [SCAN.ptx ...]     (`standpoint convert scan.e57 scan.ptx` makes them; PTX of one scan each)
"""
import sys

import numpy as np

WINDOW_COLUMNS, WINDOW_ROWS, FLAT_M, EDGE_M = 5, 7, 0.02, 0.1
HEIGHTS_M = (0.1, 0.15, 0.25, 0.4, 0.7, 1.5, 1000)


def read(name):
    with open(name) as file:
        columns, rows = int(file.readline()), int(file.readline())
        for _ in range(8):
            file.readline()
        cells = np.array([line.split()[:4] for line in file], float).reshape(columns, rows, 4)
    points = cells[..., :3]
    return points, cells[..., 3], np.any(points != 0, axis=2)


def flat_windows(points, intensity, there):
    """Along-beam and across-plane RMS, incidence and spread of intensity of windows on planes."""
    along, across, cosines, spread = [], [], [], []
    columns, rows = there.shape
    for c in range(0, columns - WINDOW_COLUMNS, WINDOW_COLUMNS):
        for r in range(0, rows - WINDOW_ROWS, WINDOW_ROWS):
            part = np.s_[c:c + WINDOW_COLUMNS, r:r + WINDOW_ROWS]
            if not there[part].all():
                continue
            near = points[part].reshape(-1, 3)
            middle = near.mean(0)
            values, vectors = np.linalg.eigh(np.cov((near - middle).T))
            normal = vectors[:, 0]
            off = (near - middle) @ normal
            if np.abs(off).max() > FLAT_M or values[0] > 0.02 * values[1]:
                continue
            beams = near / np.linalg.norm(near, axis=1)[:, None]
            cosine = np.abs(beams @ normal)
            if cosine.min() < 0.1:
                continue
            freedom = len(near) / (len(near) - 3)
            along.append(np.sqrt(np.mean((off / cosine) ** 2) * freedom))
            across.append(np.sqrt(np.mean(off ** 2) * freedom))
            cosines.append(cosine.mean())
            spread.append(intensity[part].std())
    return np.array(along), np.array(across), np.array(cosines), np.array(spread)


def edges_by_height(points, there):
    """Of depth edges along a column: heights of those without a point between their two sides and of those with one, and
    where that point lies, from 0 at the nearer side to 1 at the farther."""
    ranges = np.linalg.norm(points, axis=2)
    a, b, c, d = ranges[:, :-3], ranges[:, 1:-2], ranges[:, 2:-1], ranges[:, 3:]
    ok = there[:, :-3] & there[:, 1:-2] & there[:, 2:-1] & there[:, 3:]
    level = 0.15 * EDGE_M      # a side is two neighbours of nearly one range
    sharp = ok & (np.abs(c - b) > EDGE_M) & (np.abs(b - a) < level) & (np.abs(d - c) < level)
    whole = np.abs(d - a)
    step = ok & (whole > EDGE_M) & (np.abs(b - a) > 0.15 * whole) & (np.abs(d - b) > 0.15 * whole)
    step &= ((b - a) * (d - b) > 0) & (np.abs(d - c) < level)
    return np.abs(c - b)[sharp], whole[step], ((b - np.minimum(a, d)) / np.maximum(whole, 1e-9))[step]


for name in sys.argv[1:]:
    points, intensity, there = read(name)
    along, across, cosines, spread = flat_windows(points, intensity, there)
    sharp, mixed, place = edges_by_height(points, there)
    low, mid, high = np.percentile(along, [5, 50, 95]) * 1e3
    print(f"{name}: {there.sum()} of {there.size} cells, {len(along)} flat windows")
    print(f"  along the beam {mid:.2f} mm (5-95 %: {low:.2f}-{high:.2f}), across the plane {np.median(across) * 1e3:.2f} mm")
    for least, most in ((0.7, 1.01), (0.5, 0.7), (0.3, 0.5), (0.1, 0.3)):
        chosen = (cosines >= least) & (cosines < most)
        if chosen.sum() > 20:
            print(f"    cosine {least:.1f}-{min(most, 1):.1f}: {np.median(along[chosen]) * 1e3:.2f} mm in {chosen.sum()} windows")
    print(f"  depth edges over {EDGE_M * 100:.0f} cm along columns: {len(sharp) + len(mixed)}, with a point between: "
          f"{len(mixed)} ({100 * len(mixed) / max(1, len(sharp) + len(mixed)):.0f} %)")
    for least, most in zip(HEIGHTS_M, HEIGHTS_M[1:]):
        without, chosen = ((sharp >= least) & (sharp < most)).sum(), (mixed >= least) & (mixed < most)
        if without + chosen.sum() > 0:
            thirds = np.histogram(place[chosen], (0.15, 0.38, 0.62, 0.85))[0]
            print(f"    {least}-{most} m: {without + chosen.sum()}, {100 * chosen.sum() / (without + chosen.sum()):.0f} %, "
                  f"near/middle/far {thirds[0]}/{thirds[1]}/{thirds[2]}")
    low, middle, high = np.percentile(intensity[there], [5, 50, 95])
    print(f"  intensity 5/50/95 %: {low:.3f}/{middle:.3f}/{high:.3f}, local standard deviation {np.median(spread):.4f}, "
          f"{100 * np.median(spread) / (high - low):.1f} % of the scan's own spread")
