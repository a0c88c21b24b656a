#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The planes of one structured scan: written as an OBJ (a model where there is none), and how the stored intensity goes
with range and incidence on each. Needs numpy.

usage: planes_of_scan.py SCAN.ptx PLANES.obj     (`standpoint convert scan.e57 scan.ptx` makes the first)
"""
import sys

import numpy as np

WINDOW, OFF_M, COSINE, FEWEST, MOST, CELL_M = 3, 0.008, 0.94, 1500, 10, 0.05


def read(name):
    with open(name) as file:
        columns, rows = int(file.readline()), int(file.readline())
        for _ in range(8):
            file.readline()
        cells = np.array([line.split()[:4] for line in file], float).reshape(columns, rows, 4)
    return cells[..., :3], cells[..., 3], np.any(cells[..., :3] != 0, axis=2)


def normals(points, there):
    """Of the plane through each point's window; zero where the window has gaps or depth edges."""
    result = np.zeros_like(points)
    ranges = np.linalg.norm(points, axis=2)
    for c in range(WINDOW, points.shape[0] - WINDOW):
        for r in range(WINDOW, points.shape[1] - WINDOW):
            if not there[c, r]:
                continue
            part = np.s_[c - WINDOW:c + WINDOW + 1:3, r - WINDOW:r + WINDOW + 1:3]
            if not there[part].all() or np.ptp(ranges[part]) > 0.12:
                continue
            near = points[part].reshape(-1, 3)
            values, vectors = np.linalg.eigh(np.cov(near.T))
            if values[0] < 0.05 * values[1]:
                result[c, r] = vectors[:, 0] * -np.sign(vectors[:, 0] @ points[c, r])
    return result


def planes(points, normal, usable, random):
    for _ in range(MOST):
        index = np.argwhere(usable)
        if len(index) < FEWEST:
            return
        p, n = points[usable], normal[usable]
        best = None
        for k in random.integers(0, len(p), 300):
            mask = (np.abs((p - p[k]) @ n[k]) < OFF_M) & (n @ n[k] > COSINE)
            if best is None or mask.sum() > best.sum():
                best = mask
        for _ in range(3):
            middle = p[best].mean(0)
            axis = np.linalg.eigh(np.cov((p[best] - middle).T))[1]
            n0 = axis[:, 0] * -np.sign(axis[:, 0] @ middle)
            best = (np.abs((p - middle) @ n0) < OFF_M) & (n @ n0 > COSINE)
        if best.sum() < FEWEST:
            return
        yield index[best], middle, n0, axis
        usable[tuple(index[best].T)] = False


def quads(points, middle, axis):
    flat = (points - middle) @ axis[:, 1:]
    cells, count = np.unique(np.floor(flat / CELL_M).astype(int), axis=0, return_counts=True)
    for u, v in cells[count >= 3]:
        yield [middle + axis[:, 1] * (u + i) * CELL_M + axis[:, 2] * (v + j) * CELL_M for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]


def slope(x, y):
    """Median of the slopes between bins' medians: dB of a law against what is stored."""
    edges = np.quantile(x, np.linspace(0, 1, 9))
    middles = [(np.median(x[m]), np.median(y[m])) for m in ((x >= a) & (x <= b) for a, b in zip(edges, edges[1:])) if m.sum() > 30]
    a, b = np.array(middles).T
    return np.polyfit(a, b, 1)[0], np.corrcoef(a, b)[0, 1]


def main():
    points, intensity, there = read(sys.argv[1])
    normal = normals(points, there)
    usable = np.any(normal != 0, axis=2)
    print(f"{there.sum()} points, {usable.sum()} in flat windows")
    with open(sys.argv[2], "w") as file:
        vertices = 0
        for k, (index, middle, n0, axis) in enumerate(planes(points, normal, usable, np.random.default_rng(1))):
            p = points[tuple(index.T)]
            i = intensity[tuple(index.T)]
            ranges = np.linalg.norm(p, axis=1)
            cosine = np.abs(p @ n0) / ranges
            law = 10 * np.log10(cosine / ranges ** 2)
            per_db, r = slope(law, i)
            print(f"plane{k}: {len(p)} points, {ranges.min():.2f}-{ranges.max():.2f} m, "
                  f"{np.degrees(np.arccos(cosine.max())):.0f}-{np.degrees(np.arccos(cosine.min())):.0f} deg, normal {np.round(n0, 2)}, "
                  f"intensity {np.quantile(i, .05):.3f} {np.median(i):.3f} {np.quantile(i, .95):.3f}; "
                  f"{per_db:+.5f} per dB of cos/R2, correlation of bins {r:+.2f}, dB span {np.ptp(np.quantile(law, [.02, .98])):.1f}")
            file.write(f"o plane{k}\nusemtl plane{k}\n")
            for quad in quads(p, middle, axis):
                face = np.array(quad)
                if np.cross(face[1] - face[0], face[3] - face[0]) @ n0 < 0:
                    face = face[::-1]
                file.writelines("v %.5f %.5f %.5f\n" % tuple(v) for v in face)
                file.write("f %d %d %d %d\n" % tuple(range(vertices + 1, vertices + 5)))
                vertices += 4


main()
