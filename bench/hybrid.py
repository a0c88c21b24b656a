#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A walk with a handheld scanner through twelve rooms, alone and held by scans from a tripod. Needs Debian's
python3-numpy and python3-matplotlib.

usage: hybrid.py STANDPOINT OUTDIR [SEEDS]   (10 without)

60 m by 40 m in twelve rooms, one loop through all of them, a station in each. Scanned once with the BLK2GO's data (a
hundredth of its pulses), for each seed with its trajectory open, closed, closed and held by control points, and closed
and held by stations, which are scanned with the Focus S350's. Figures are millimetres: of the trajectory in plan and in
height, root of the mean square over all seeds, and distances of points from where they truly are.
"""
import json
import math
import os
import shutil
import sys

import numpy as np

from own_points import boxes_as_obj, read_ply, run

HERE = os.path.dirname(os.path.realpath(__file__))
MODEL = os.path.join(HERE, "..", "scanners", "instruments", "leica-blk2go.json")
ROOM = (15.0, 40 / 3)
CYCLE = [(0, 0), (1, 0), (2, 0), (3, 0), (3, 1), (3, 2), (2, 2), (2, 1), (1, 1), (1, 2), (0, 2), (0, 1)]


def building():
    boxes = [("Floor", (-0.2, -0.2, -0.3), (60.2, 40.2, 0)), ("Roof", (-0.2, -0.2, 3), (60.2, 40.2, 3.3))]
    for axis in (0, 1):
        across = 1 - axis
        size, count = ROOM[axis], (4, 3)[axis]
        others, each = (4, 3)[across], ROOM[across]
        for line in range(count + 1):
            at = line * size
            for k in range(others):
                pieces = [(k * each, (k + 1) * each)] if line in (0, count) else \
                    [(k * each, (k + 0.5) * each - 1), ((k + 0.5) * each + 1, (k + 1) * each)]
                for low, high in pieces:
                    a, b = [0.0] * 3, [0.0] * 3
                    a[axis], b[axis], a[across], b[across], b[2] = at - 0.1, at + 0.1, low, high, 3
                    boxes.append(("Wall", tuple(a), tuple(b)))
    rng = np.random.default_rng(1)
    for i in range(4):
        for k in range(3):  # furniture, so that rooms differ
            for _ in range(3):
                x, y = (i + rng.uniform(0.1, 0.3)) * ROOM[0], (k + rng.uniform(0.1, 0.3)) * ROOM[1]
                boxes.append(("Cabinet", (x, y, 0), (x + rng.uniform(0.5, 1.5), y + 0.6, rng.uniform(0.8, 2.2))))
    return "mtllib hybrid.mtl\n" + boxes_as_obj(boxes, "Plaster")


def middle(room):
    return np.array([(room[0] + 0.5) * ROOM[0], (room[1] + 0.5) * ROOM[1]])


def way():
    """Through each room: in by its door, along its far side, past its middle, with a stop there."""
    places = []
    for number, room in enumerate(CYCLE):
        here, before, after = (middle(r) for r in (room, CYCLE[number - 1], CYCLE[(number + 1) % 12]))
        enter, leave = (before + here) / 2, (here + after) / 2
        side = np.array([ROOM[0], ROOM[1]]) * 0.28
        places += [(enter, 0), (here + side * (1, -1), 0), (here, 1), (here + side, 0), (leave, 0)]
    kept = [places[0]]
    for place in places[1:]:
        if np.linalg.norm(place[0] - kept[-1][0]) > 0.5:
            kept.append(place)
    kept[-1] = (kept[-1][0], 2)  # where it began
    return [f"{p[0]:.3f},{p[1]:.3f},0" + (f":{stop}" if stop else "") for p, stop in kept]


def slower(name):
    with open(MODEL) as file:
        data = json.load(file)
    data["id"] = name
    data["moving"]["points_per_s"]["value"] /= 100
    data["moving"]["firing_us"]["value"] *= 100.007  # so that pulses do not fall into step with the mirror
    with open(name + ".json", "w") as file:
        json.dump(data, file)


def errors_of(file):
    """Of each point of a binary PLY of ours: where it is less where it truly is, mm."""
    points, _ = read_ply(file)
    whole = points["Flags"] == 0  # without mixed pixels and the like
    return 1000 * np.column_stack([points[a] - points["True" + a.upper()] for a in "xyz"])[whole]


def rms(errors):
    return math.sqrt((errors ** 2).sum(axis=1).mean())


def written(standpoint, *options):
    run(standpoint, "trajectory", "p", "--write", "walk", "-o", "walk.csv", "--rate", "10", *options)
    return np.loadtxt("walk.csv", delimiter=",", comments=("#", "t"), usecols=(1, 2, 3))


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    standpoint, folder, seeds = os.path.abspath(sys.argv[1]), sys.argv[2], int((sys.argv + ["10"])[3])
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    os.chdir(folder)
    with open("hybrid.obj", "w") as file:
        file.write(building())
    with open("hybrid.mtl", "w") as file:
        file.write("newmtl Plaster\nKd 0.8 0.8 0.8\n")
    slower("handheld")
    run(standpoint, "import", "hybrid.obj", "-o", "p", "--up", "z", "--allow-loss")
    run(standpoint, "materials", "p")
    print(run(standpoint, "trajectory", "p", "--add", "walk", "--through", *way()))
    for number, room in enumerate(CYCLE):
        x, y = middle(room) + (1.0, 0.5)
        run(standpoint, "station", "p", "--add", f"S{number + 1:02}", "--on", f"{x},{y},0")
    os.makedirs("tripod")
    run(standpoint, "scan", "p", "--instrument", "faro-focus-s350", "-o", "tripod", "--truth", "--set", "resolution=1/16", "quality=4x")
    tripod = []
    for file in sorted(os.listdir("tripod")):
        run(standpoint, "convert", os.path.join("tripod", file), "station.ply")
        tripod.append(rms(errors_of("station.ply")))
    print(f"a scan from a tripod, its place known: mean {np.mean(tripod):.1f}")
    with open("control.txt", "w") as file:
        for number, room in enumerate(CYCLE[::2]):
            x, y = middle(room)
            file.write(f"C{number + 1} {x} {y} 0 2\n")
    kinds = {"open": ("--closures", "off"), "closed": (), "control points": ("--control", "control.txt"), "stations": ("--anchors", "on")}
    found = {kind: [] for kind in kinds}
    off = {kind: [] for kind in kinds}
    true = written(standpoint)
    print(f"a walk of {np.linalg.norm(np.diff(true, axis=0), axis=1).sum():.0f} m")
    for seed in range(1, seeds + 1):
        for kind, options in kinds.items():
            run(standpoint, "scan", "p", "--trajectory", "walk", "--instrument", "handheld.json", "-o", "walk.ply", "--truth",
                "--quality", "preview", "--operator", "off", "--seed", str(seed), *options)
            found[kind].append(rms(errors_of("walk.ply")))
            off[kind].append(1000 * (written(standpoint, "--solved-for", "leica-blk2go", "--error-seed", str(seed), *options) - true))
    for kind, values in found.items():
        plan, height = rms(np.concatenate(off[kind])[:, :2]), rms(np.concatenate(off[kind])[:, 2:])
        print(f"{kind:16} trajectory {plan:5.1f} in plan, {height:5.1f} in height   points mean {np.mean(values):6.1f}   least {min(values):6.1f}   most {max(values):6.1f}   each {np.round(values, 1)}")


if __name__ == "__main__":
    main()
