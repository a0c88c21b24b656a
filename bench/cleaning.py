#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What filters take of what moved, by class and range, and how a cleaning is scored. Needs Debian's python3-numpy and
python3-scipy.

usage: cleaning.py STANDPOINT SAMPLES OUTDIR [corridor] [house] [street] [walk] [score]

SAMPLES is the folder with house.ifc and street.ifc (build/release/samples). Without a name all are made:

corridor  a wall 5 m away, 3 mm of noise, somebody 3 m away who has moved on by 4 m when it is scanned again: of her
          points that have the wall behind them all should go, of a million others none
house     the sample house with two who walk up and down and three stations, each at a time of its own
street    the sample street with a crowd of 20, likewise
walk      a handheld scanner carried through the house and past them
score     a tenth of the corridor's first scan, cleaned, put into another order, rounded to millimetres and moved by whole
          metres: what `score --cleaning` says beside the same by SciPy's KD tree
"""
import json
import os
import sys

import numpy as np
from scipy.spatial import cKDTree

from own_points import boxes_as_obj, read_ply, run

MOVING = 32
FLAWED = 1 | 2 | 8 | 32 | 64
WALKERS = [["Ada", "--through", "2.2,3", "5.8,3", "--repeat"], ["Ben", "--through", "2.5,2.2", "5.5,2.4", "--repeat", "--begin", -7]]
RANGES = [0, 3, 6, 10, 20, 1e9]


def corridor():
    """Walls at y = ±5 m, 60 m long and 3 m high, and a floor."""
    boxes = [("Wall", (-30, 5, 0), (30, 5.2, 3)), ("Wall", (-30, -5.2, 0), (30, -5, 3)), ("Floor", (-30, -5.2, -0.2), (30, 5.2, 0))]
    return boxes_as_obj(boxes)


class Bench:
    def __init__(self, standpoint, samples, folder):
        self.standpoint, self.samples, self.folder = standpoint, samples, folder
        os.makedirs(folder, exist_ok=True)

    def run(self, *words):
        return run(self.standpoint, *map(str, words), losing=True, folder=self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def points(self, cloud):
        """Places in the file's frame, ranges, flags."""
        ply = cloud.replace(".e57", ".ply")
        self.run("convert", cloud, ply)
        columns, _ = read_ply(self.path(ply))
        places = np.stack([columns[axis].astype(float) for axis in "xyz"], 1)
        return places, columns["TrueRange"].astype(float), columns["Flags"].astype(int)

    def cleaned(self, cloud, *filters):
        answer = json.loads(self.run("clean", cloud, "-o", "cleaned.e57", "--filters", *filters, "--json"))
        return answer["filters"][-1]

    def show(self, title, row):
        moving, good = row["truth"]["moving"], row["good"]
        lost = ", ".join(f"{name[3:]} {100 * c['share']:.3f} %" for name, c in sorted(row["classes"].items()) if c["removed"])
        print(f"{title:52} {row['removed']:8} recall {100 * (moving['recall'] or 0):6.2f} % of {moving['in']}, "
              f"precision {100 * (moving['precision'] or 0):6.2f} %, good lost {100 * good['share']:.4f} % ({good['removed']} of "
              f"{good['in']}): {lost}", flush=True)

    def by_range(self, title, cloud):
        """Recall of what moved and loss of the rest by range: which points are left is found by their places."""
        before, ranges, flags = self.points(cloud)
        after, _, _ = self.points("cleaned.e57")
        moving = flags & MOVING != 0
        some = moving | (np.arange(len(flags)) % 20 == 0)
        before, ranges, moving = before[some], ranges[some], moving[some]
        left = cKDTree(after).query(before, distance_upper_bound=1e-4, workers=2)[0] < 1e-4
        text = []
        for low, high in zip(RANGES, RANGES[1:]):
            here = (ranges >= low) & (ranges < high)
            m, g = here & moving, here & ~moving
            if m.any():
                text.append(f"{low:g}–{high:g} m: {100 * (~left[m]).mean():.1f} % of {m.sum()}, lost {100 * (~left[g]).mean():.3f} %")
        print(f"    by range, {title}: " + "; ".join(text), flush=True)


def measure_corridor(bench):
    with open(bench.path("corridor.obj"), "w") as obj:
        obj.write(corridor())
    bench.run("import", "corridor.obj", "-o", "corridor", "--up", "z", "--replace")
    bench.run("collide", "corridor")
    bench.run("mover", "corridor", "--add", "Ada", "--through", "-2,3:1000", "2,3:1000")
    bench.run("station", "corridor", "--add", "S1", "--on", "0,0")
    for name, begin in (("first", 0), ("second", 2000)):
        bench.run("scan", "corridor", "--instrument", "faro-focus-s350", "--set", "resolution=1/8", "--movers-from", begin,
                  "--without", "footprint,bias,striping,angle-noise,near-range,variation,quantisation,levelling,range-offset,incidence-noise,amplitude-noise",
                  "--seed", 1 + begin, "--truth", "-o", f"{name}.e57")
    places, _, flags = bench.points("first.e57")
    moving = flags & MOVING != 0
    origin = np.array(json.loads(bench.run("info", "first.e57", "--json"))["scans"][0]["translation"])
    way = places - origin
    behind = origin[2] + way[:, 2] * (5 - origin[1]) / np.where(way[:, 1] > 0.1, way[:, 1], np.nan)  # height on the wall
    walled = moving & (behind > 0.05) & (behind < 2.95)
    for filters in ("moving:against=second.e57", "moving:against=second.e57,cell=0.1", "seen-through:against=second.e57"):
        row = bench.cleaned("first.e57", filters)
        bench.show("corridor, " + filters, row)
        after, _, _ = bench.points("cleaned.e57")
        left = cKDTree(after).query(places, distance_upper_bound=1e-5, workers=2)[0] < 1e-5
        print(f"    of {walled.sum()} of her points with the wall behind {walled.sum() - (walled & left).sum()} went, "
              f"of {(~moving).sum()} others {(~moving & ~left).sum()}", flush=True)


def measure_stations(bench, name, stations, movers, settings):
    if not os.path.exists(bench.path(f"{name}-0.e57")):
        bench.run("import", os.path.join(bench.samples, name + ".ifc"), "-o", name, "--replace")
        bench.run("collide", name)
        bench.run("materials", name)
        for words in movers:
            bench.run("mover", name, "--add", *words)
        for k, at in enumerate(stations):
            bench.run("station", name, "--add", f"T{k}", "--on", at)
        for k in range(len(stations)):
            bench.run("scan", name, "--stations", f"T{k}", "--instrument", "faro-focus-s350", "--set", *settings, "--truth",
                      "--movers-from", 300 * k, "-o", f"{name}-{k}.e57")
        bench.run("scan", name, "--stations", "T0", "--instrument", "faro-focus-s350", "--set", *settings, "--truth",
                  "--movers-from", 1500, "--seed", 2, "-o", f"{name}-again.e57")
    first = f"{name}-0.e57"
    others = [f"{name}-{k}.e57" for k in range(1, len(stations))]
    for kind in ("moving", "seen-through"):
        for against in ([f"{name}-again.e57"], others[:1], others):
            filters = [f"{kind}:against={file}" for file in against]
            total = json.loads(bench.run("clean", first, "-o", "cleaned.e57", "--filters", *filters, "--json"))
            bench.show(f"{name}, {kind} against {' '.join(against)}", summed(total["filters"]))
            if against == others[:1]:
                bench.by_range(kind, first)
    for more in ("cell=0.05", "cell=0.2", "rays=3", "distance=0.1"):
        bench.show(f"{name}, seen-through against {others[0]}, {more}", bench.cleaned(first, f"seen-through:against={others[0]},{more}"))


def summed(rows):
    """Several filters, one after the other, as one."""
    first = json.loads(json.dumps(rows[0]))
    removed = sum(row["removed"] for row in rows)

    def add(key, into):
        parts = [row[key[0]][key[1]] if len(key) == 2 else row[key[0]] for row in rows if len(key) == 1 or key[1] in row[key[0]]]
        into["removed"] = sum(p["removed"] for p in parts)
        return into["removed"] / into["in"] if into["in"] else None
    moving = first["truth"]["moving"]
    moving["recall"] = add(("truth", "moving"), moving)
    moving["precision"] = moving["removed"] / removed if removed else None
    first["good"]["share"] = add(("good",), first["good"])
    for name, c in first["classes"].items():
        c["share"] = add(("classes", name), c)
    first["removed"] = removed
    return first


def measure_walk(bench):
    if not os.path.exists(bench.path("walk.e57")):
        bench.run("import", os.path.join(bench.samples, "house.ifc"), "-o", "walked", "--replace")
        bench.run("collide", "walked")
        bench.run("materials", "walked")
        for words in WALKERS:
            bench.run("mover", "walked", "--add", *words)
        bench.run("trajectory", "walked", "--add", "walk", "--through", "2.2,3,0", "5.8,3,0", "5.8,2,0", "2.2,2,0", "2.2,3,0", "5.8,3,0",
                  "--carrier", "hand")
        bench.run("scan", "walked", "--trajectory", "walk", "--instrument", "leica-blk2go", "--truth", "-o", "walk.e57")
    filters = "seen-through:trajectory=walk.trajectory.csv"
    for more in ("", ",cell=0.05", ",cell=0.2", ",slice=0.5", ",slice=2", ",votes=3", ",share=0.3", ",rays=3", ",distance=0.1"):
        bench.show("walk, seen-through " + more[1:], bench.cleaned("walk.e57", filters + more))


def measure_score(bench):
    """A tenth of the corridor's first scan, cleaned by another hand."""
    bench.run("clean", "first.e57", "-o", "tenth.e57", "--filters", "every:n=10")
    places, _, flags = bench.points("tenth.e57")
    flawed = flags & FLAWED != 0
    rng = np.random.default_rng(7)
    keep = np.where(flags & MOVING != 0, rng.random(len(flags)) < 0.1, rng.random(len(flags)) < 0.97)
    keep &= ~((places[:, 2] > 2.2) & (rng.random(len(flags)) < 0.3))
    order = rng.permutation(np.flatnonzero(keep))
    shift = np.array([3000.0, 400.0, 0.0])
    np.savetxt(bench.path("by-hand.xyz"), places[order] - shift, fmt="%.3f")
    answer = json.loads(bench.run("score", "tenth.e57", "by-hand.xyz", "--cleaning", "--json"))
    # Each point of the other file goes to the nearest of the truth that is free, the nearest pairs first.
    rounded = np.round(places[order] - shift, 3) + shift
    tree = cKDTree(places)
    distance, near = tree.query(rounded, k=8, distance_upper_bound=1e-3, workers=2)
    rows, slots = np.nonzero(np.isfinite(distance))
    pairs = np.lexsort((rows, near[rows, slots], distance[rows, slots]))
    taken, used = np.zeros(len(places), bool), np.zeros(len(rounded), bool)
    for pair in pairs:
        r, t = rows[pair], near[rows[pair], slots[pair]]
        if not taken[t] and not used[r]:
            taken[t] = used[r] = True
    print(f"score: shift {answer['shift_m']}, of {len(places)} points {answer['removed']} removed; truly {(~keep).sum()}, by KD tree {(~taken).sum()}")
    print(f"    flawed {answer['flawed']['removed']}; truly {(~keep & flawed).sum()}, by KD tree {(~taken & flawed).sum()}")
    print(f"    good {answer['good']['removed']}; truly {(~keep & ~flawed).sum()}, by KD tree {(~taken & ~flawed).sum()}")
    print(f"    moving {answer['causes']['moving']['removed']}; truly {(~keep & (flags & MOVING != 0)).sum()}; "
          f"doubled {answer['doubled']}, unknown {answer['unknown']}", flush=True)


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    bench = Bench(os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), os.path.abspath(sys.argv[3]))
    wanted = sys.argv[4:] or ["corridor", "house", "street", "walk", "score"]
    if "corridor" in wanted:
        measure_corridor(bench)
    if "house" in wanted:
        measure_stations(bench, "house", ["4.3,1.6,0", "2.4,3.4,0", "6.3,3.2,0"], WALKERS, ["resolution=1/8", "quality=2x"])
    if "street" in wanted:
        measure_stations(bench, "street", ["-8,-19,-0.27", "8,-19,-0.27", "0,-22,-0.27"], [["crowd", "--kind", "crowd", "--count", 20]], ["resolution=1/8", "quality=2x"])
    if "walk" in wanted:
        measure_walk(bench)
    if "score" in wanted:
        measure_score(bench)


if __name__ == "__main__":
    main()
