#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The deviations that `standpoint optimize` states beside what CloudCompare measures between the exported models, whole and by product.

usage: deviation_beside_cloudcompare.py STANDPOINT MODEL:BUDGET ...      needs: apt install cloudcompare xvfb

Both directions: 100 000 points by area for the mean (of the two means), these and all vertices for the maximum, each with
CloudCompare's distance to the other mesh; its 100 largest figures, and those that are no number, are looked at again by exhaustion, as it
misses long thin triangles at times: a nearer triangle refutes them (the count is printed). By product: the five whose stated maximum is largest, of those with a name of their own.
"""
import collections
import itertools
import json
import os
import random
import re
import subprocess
import sys
import tempfile

SAMPLES = 100_000


def read(path):
    """Positions, and the triangles of each object by its name with the number behind it, which the exporter adds."""
    positions, objects, current = [], collections.OrderedDict(), None
    for line in open(path, encoding="utf-8"):
        word = line.split(None, 1)
        if not word:
            continue
        if word[0] == "v":
            positions.append(tuple(float(x) for x in word[1].split()[:3]))
        elif word[0] == "o":
            current = objects.setdefault(word[1].strip(), [])
        elif word[0] == "f":
            current.append(tuple(int(corner.split("/")[0]) - 1 for corner in word[1].split()))
    return positions, objects


def sampled(positions, triangles, count, generator):
    def area(t):
        a, b, c = (positions[i] for i in t)
        u, v = [b[k] - a[k] for k in range(3)], [c[k] - a[k] for k in range(3)]
        return 0.5 * sum((u[i] * v[j] - u[j] * v[i]) ** 2 for i, j in ((0, 1), (1, 2), (2, 0))) ** 0.5
    sums = list(itertools.accumulate(area(t) for t in triangles))
    points = []
    for t in generator.choices(triangles, cum_weights=sums, k=count):
        a, b, c = (positions[i] for i in t)
        u, v = generator.random(), generator.random()
        if u + v > 1:
            u, v = 1 - u, 1 - v
        points.append(tuple(a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]) for k in range(3)))
    return points


def distances(points, positions, triangles, folder):
    used = sorted({i for t in triangles for i in t})
    index = {v: i + 1 for i, v in enumerate(used)}
    with open(f"{folder}/mesh.obj", "w") as out:
        out.writelines("v %r %r %r\n" % positions[v] for v in used)
        out.writelines("f %d %d %d\n" % tuple(index[v] for v in t) for t in triangles)
    with open(f"{folder}/points.xyz", "w") as out:
        out.writelines("%r %r %r\n" % p for p in points)
    for old in os.listdir(folder):
        if "C2M" in old:
            os.remove(f"{folder}/{old}")
    subprocess.run(["xvfb-run", "-a", "CloudCompare", "-SILENT", "-C_EXPORT_FMT", "ASC", "-PREC", "9", "-NO_TIMESTAMP", "-O", "points.xyz", "-O", "mesh.obj", "-C2M_DIST"],
                   cwd=folder, capture_output=True, check=True)
    written = next(f for f in os.listdir(folder) if "C2M" in f)
    return [abs(float(line.split()[3])) for line in open(f"{folder}/{written}") if not line.startswith("//")]


def exhaustive(p, positions, triangles):
    """Distance of a point from the nearest of all triangles."""
    def minus(a, b):
        return a[0] - b[0], a[1] - b[1], a[2] - b[2]

    def dot(a, b):
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]

    def cross(a, b):
        return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]

    best = float("inf")
    for t in triangles:
        corners = [positions[i] for i in t]
        if any(min(c[k] for c in corners) - p[k] > best or p[k] - max(c[k] for c in corners) > best for k in range(3)):
            continue
        normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]))
        inside = dot(normal, normal) > 0
        for a, b in zip(corners, corners[1:] + corners[:1]):
            edge, aside = minus(b, a), minus(p, a)
            share = max(0, min(1, dot(aside, edge) / dot(edge, edge))) if dot(edge, edge) > 0 else 0
            off = minus(aside, tuple(share * x for x in edge))
            best = min(best, dot(off, off) ** 0.5)
            inside = inside and dot(cross(edge, aside), normal) >= 0
        if inside:
            best = min(best, abs(dot(minus(p, corners[0]), normal)) / dot(normal, normal) ** 0.5)
    return best


def compare(before, after, folder):
    """Mean and maximum, as the program defines them, and how many of CloudCompare's figures are refuted."""
    generator, means, most, refuted = random.Random(1), [], 0, 0
    for (positions, triangles), (other, others) in ((before, after), (after, before)):
        points = sampled(positions, triangles, SAMPLES, generator)
        vertices = [positions[v] for v in sorted({i for t in triangles for i in t})]
        places = points + vertices
        found = distances(places, other, others, folder)
        for i in sorted(range(len(found)), key=lambda i: found[i] if found[i] == found[i] else float("inf"))[-100:]:
            true = exhaustive(places[i], other, others)
            if not found[i] <= 1.01 * true + 1e-6:
                found[i], refuted = true, refuted + 1
        means.append(sum(found[:SAMPLES]) / SAMPLES)
        most = max(most, max(found))
    return sum(means) / 2, most, refuted


def main():
    program = sys.argv[1]
    for argument in sys.argv[2:]:
        model, budget = argument.rsplit(":", 1)
        with tempfile.TemporaryDirectory() as folder:
            def run(*arguments):
                return json.loads(subprocess.run([program, *arguments, "--json", "--allow-loss"], capture_output=True).stdout)
            run("import", model, "-o", folder + "/p")
            run("export", folder + "/p", "-o", folder + "/before.obj")
            stated = run("optimize", folder + "/p", "--budget", budget, "--max-deviation", "0.05")
            run("export", folder + "/p", "-o", folder + "/after.obj")
            (positions, objects), (others, other_objects) = read(folder + "/before.obj"), read(folder + "/after.obj")
            print(f"{os.path.basename(model)}: {stated['triangles_before']} -> {stated['triangles_after']}")
            rows = [("whole", stated, sum(objects.values(), []), sum(other_objects.values(), []))]
            names = collections.Counter(p["name"] for p in stated["products"])
            numbered = {name.rpartition(".")[0]: name for name in objects if name in other_objects}
            single = [p for p in stated["products"] if names[p["name"]] == 1 and p["name"] in numbered and p["triangles_after"] < p["triangles_before"]]
            for p in sorted(single, key=lambda p: -p["max_deviation_m"])[:5]:
                rows.append((p["name"], p, objects[numbered[p["name"]]], other_objects[numbered[p["name"]]]))
            for name, figures, triangles, other_triangles in rows:
                mean, most, refuted = compare((positions, triangles), (others, other_triangles), folder)
                shares = [100 * (a / b - 1) if b > 0 else 0 for a, b in ((figures["mean_deviation_m"], mean), (figures["max_deviation_m"], most))]
                print(f"  mean {1000 * figures['mean_deviation_m']:8.4f} mm, CloudCompare {1000 * mean:8.4f} ({shares[0]:+5.1f} %)"
                      f"   max {1000 * figures['max_deviation_m']:8.3f} mm, {1000 * most:8.3f} ({shares[1]:+5.1f} %)   {re.sub(r'[^ -~]', '?', name)[:40]}"
                      + (f"   ({refuted} refuted)" if refuted else ""), flush=True)


main()
