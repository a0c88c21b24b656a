#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What makes points look real, measured in the same way on structured scans, a real one and ours: noise on flat windows,
points between the two sides of a depth edge, and how the stored intensity varies on flat windows. Needs numpy.

usage: fidelity.py SCAN.ptx [SCAN.ptx ...]     (`standpoint convert scan.e57 scan.ptx` makes them; PTX of one scan each)
"""
import sys

import numpy as np

WINDOW_COLUMNS, WINDOW_ROWS, FLAT_M, EDGE_M = 5, 7, 0.02, 0.05


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


def between_share(points, there):
    """Of depth edges along a column, the share that has a point between its two sides."""
    ranges = np.linalg.norm(points, axis=2)
    edges = mixed = 0
    for column, valid in zip(ranges, there):
        ok = valid[:-3] & valid[1:-2] & valid[2:-1] & valid[3:]
        a, b, c, d = column[:-3], column[1:-2], column[2:-1], column[3:]
        # b and c lie on the two sides, or one of them lies between.
        jump = ok & (np.abs(c - b) > EDGE_M)
        edge_sharp = jump & (np.abs(b - a) < 0.3 * EDGE_M) & (np.abs(d - c) < 0.3 * EDGE_M)
        whole = np.abs(d - a)
        step = ok & (whole > 2 * EDGE_M) & (np.abs(b - a) > 0.15 * whole) & (np.abs(d - b) > 0.15 * whole)
        step &= ((b - a) * (d - b) > 0) & (np.abs(d - c) < 0.3 * EDGE_M)
        edges += int(edge_sharp.sum() + step.sum())
        mixed += int(step.sum())
    return edges, mixed


for name in sys.argv[1:]:
    points, intensity, there = read(name)
    along, across, cosines, spread = flat_windows(points, intensity, there)
    edges, mixed = between_share(points, there)
    low, mid, high = np.percentile(along, [5, 50, 95]) * 1e3
    print(f"{name}: {there.sum()} of {there.size} cells, {len(along)} flat windows")
    print(f"  along the beam {mid:.2f} mm (5-95 %: {low:.2f}-{high:.2f}), across the plane {np.median(across) * 1e3:.2f} mm")
    for least, most in ((0.7, 1.01), (0.5, 0.7), (0.3, 0.5), (0.1, 0.3)):
        chosen = (cosines >= least) & (cosines < most)
        if chosen.sum() > 20:
            print(f"    cosine {least:.1f}-{min(most, 1):.1f}: {np.median(along[chosen]) * 1e3:.2f} mm in {chosen.sum()} windows")
    print(f"  depth edges over {2 * EDGE_M * 100:.0f} cm along columns: {edges}, with a point between: {mixed} ({100 * mixed / max(1, edges):.0f} %)")
    figures = intensity[there]
    print(f"  intensity 5/50/95 %: {np.percentile(figures, 5):.3f}/{np.median(figures):.3f}/{np.percentile(figures, 95):.3f}, local standard deviation {np.median(spread):.4f}")
