#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A scan of a sample, moved by a known motion, registered to its model by `standpoint underlay --register --icp` and by
CloudCompare's -ICP (points to mesh). Prints what either leaves of the motion, at the corners of the scan's box.

usage: registration_beside_cloudcompare.py MODEL.ifc X,Y [--ideal]   (STANDPOINT: the command, default `standpoint`)
"""
import glob, itertools, json, math, os, subprocess, sys, tempfile

STANDPOINT = os.environ.get("STANDPOINT", "standpoint")
SHIFT, YAW_DEG, EVERY = (0.03, -0.02, 0.02), 0.3, 20


def run(*words):
    done = subprocess.run([STANDPOINT, *words, "--json"], capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stderr)
    return json.loads(done.stdout)


def scanned(project, folder, x_y):
    run("station", project, "--add", "S1", "--on", x_y)
    run("scan", project, "--instrument", "leica-rtc360", "--set", "resolution=12mm", *sys.argv[3:], "-o", f"{folder}/scan.ptx")
    with open(f"{folder}/scan.ptx") as file:
        lines = file.read().split("\n")
    pose = [list(map(float, line.split())) for line in lines[6:10]]
    points = []
    for line in lines[10::EVERY]:
        words = line.split()
        if len(words) < 4 or words[:3] == ["0", "0", "0"]:
            continue
        p = list(map(float, words[:3])) + [1]
        if p[:3] != [0, 0, 0]:
            points.append([sum(p[k] * pose[k][i] for k in range(4)) for i in range(3)])
    return points


def moved(p):
    c, s = math.cos(math.radians(YAW_DEG)), math.sin(math.radians(YAW_DEG))
    return [c * p[0] - s * p[1] + SHIFT[0], s * p[0] + c * p[1] + SHIFT[1], p[2] + SHIFT[2]]


def turned(q, v):
    w, x, y, z = q
    t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])]
    return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2], v[2] + w * t[2] + x * t[1] - y * t[0]]


def by_standpoint(project, cloud):
    run("underlay", project, "--add", cloud, "--name", "moved", "--at", "0,0,0")
    answer = run("underlay", project, "--register", "moved", "--icp")["registered"]
    pose = answer["pose"]
    print("standpoint:", json.dumps(answer["icp"]))
    return lambda p: [a + b for a, b in zip(turned(pose["rotation"], p), pose["translation"])]


def by_cloudcompare(model, cloud, folder):
    subprocess.run(["CloudCompare", "-SILENT", "-AUTO_SAVE", "OFF", "-O", cloud, "-O", model, "-ICP", "-ITER", "200", "-MIN_ERROR_DIFF",
                    "1e-9", "-OVERLAP", "95", "-RANDOM_SAMPLING_LIMIT", "60000"],
                   env={**os.environ, "QT_QPA_PLATFORM": "offscreen"}, check=True, stdout=subprocess.DEVNULL)
    found = glob.glob(f"{folder}/*REGISTRATION_MATRIX*.txt")
    matrix = [list(map(float, line.split())) for line in open(found[0]) if line.strip()]
    return lambda p: [sum(matrix[i][k] * p[k] for k in range(3)) + matrix[i][3] for i in range(3)]


def main():
    with tempfile.TemporaryDirectory() as folder:
        project = f"{folder}/p"
        run("import", sys.argv[1], "-o", project, "--shift", "none")
        run("materials", project)
        points = scanned(project, folder, sys.argv[2])
        cloud = f"{folder}/moved.xyz"
        with open(cloud, "w") as file:
            file.writelines("%.6f %.6f %.6f\n" % tuple(moved(p)) for p in points)
        run("export", project, "-o", f"{folder}/model.obj")
        ours, theirs = by_standpoint(project, cloud), by_cloudcompare(f"{folder}/model.obj", cloud, folder)
        low, high = [min(p[i] for p in points) for i in range(3)], [max(p[i] for p in points) for i in range(3)]
        corners = [list(c) for c in itertools.product(*zip(low, high))]
        for name, back in ("standpoint", ours), ("cloudcompare", theirs):
            print(f"{name}: at most {max(math.dist(back(moved(c)), c) for c in corners) * 1000:.2f} mm left at the corners")
        print(f"between them: {max(math.dist(ours(moved(c)), theirs(moved(c))) for c in corners) * 1000:.2f} mm, "
              f"{len(points)} points, box {[round(b - a, 1) for a, b in zip(low, high)]} m")


main()
