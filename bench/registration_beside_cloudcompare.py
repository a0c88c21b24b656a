#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A scan, moved by known motions, registered to its model by `standpoint underlay --register --icp`, by CloudCompare's -ICP
(points to mesh), and by Open3D (point to plane, where its module is installed). Prints what each leaves of the motion, at the
corners of the scan's box. The clouds are lists of points: nothing says from where they were seen.

usage: registration_beside_cloudcompare.py [MODEL.ifc X,Y …] [--ideal]   (STANDPOINT: the command, default `standpoint`)
Without a model it makes a room that is fair to all: L-shaped, faces of one side, a column, a sloping ceiling, no glass.
"""
import glob, itertools, json, math, os, subprocess, sys, tempfile

STANDPOINT = os.environ.get("STANDPOINT", "standpoint")
EVERY = 20
AXIS = (0.2, 0.3, 0.9327379053)                      # of the turns, about the origin
ALONG = (0.78, -0.52, 0.3482815)                     # of the shifts
MOTIONS = [(cm, degrees) for cm in (5, 15) for degrees in (0.3, 1.5)]
L_SHAPE = [(0, 0), (8, 0), (8, 3.5), (4, 3.5), (4, 7), (0, 7)]
COLUMN = [(1.6, 2.2), (1.6, 2.8), (2.2, 2.8), (2.2, 2.2)]    # the other way round: it is seen from outside


def run(*words):
    done = subprocess.run([STANDPOINT, *words, "--json"], capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stderr)
    return json.loads(done.stdout)


def ceiling(x, y):
    return 2.6 + 0.12 * y + 0.02 * x


def write_room(file):
    corners, faces = [], []

    def face(*points):
        first = len(corners) + 1
        faces.extend(((first, first + 1, first + 2), (first, first + 2, first + 3)))   # Open3D reads triangles only
        corners.extend(points)

    for outline in L_SHAPE, COLUMN:
        for (x, y), (u, v) in zip(outline, outline[1:] + outline[:1]):
            face((x, y, 0), (x, y, ceiling(x, y)), (u, v, ceiling(u, v)), (u, v, 0))
    for x, y, u, v in (0, 0, 8, 3.5), (0, 3.5, 4, 7):
        face((x, y, 0), (u, y, 0), (u, v, 0), (x, v, 0))
        face(*((a, b, ceiling(a, b)) for a, b in ((x, y), (x, v), (u, v), (u, y))))
    with open(file, "w") as out:
        out.writelines("v %.6f %.6f %.6f\n" % c for c in corners)
        out.write("o room\n")
        out.writelines("f " + " ".join(map(str, f)) + "\n" for f in faces)


def scanned(project, folder, places, more):
    for n, place in enumerate(places):
        run("station", project, "--add", f"S{n}", "--on", place)
    run("scan", project, "--instrument", "leica-rtc360", "--set", "resolution=12mm", *more, "-o", f"{folder}/scan.ptx")
    points = []
    with open(f"{folder}/scan.ptx") as file:
        lines = file.read().split("\n")
    start = 0
    while start + 10 < len(lines):
        count = int(lines[start]) * int(lines[start + 1])
        pose = [list(map(float, line.split())) for line in lines[start + 6:start + 10]]
        for line in lines[start + 10:start + 10 + count:EVERY]:
            p = list(map(float, line.split()[:3])) + [1]
            if p[:3] != [0, 0, 0]:
                points.append([sum(p[k] * pose[k][i] for k in range(4)) for i in range(3)])
        start += 10 + count
    return points


def moved(p, motion):
    cm, degrees = motion
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    x, y, z = AXIS
    cross = [y * p[2] - z * p[1], z * p[0] - x * p[2], x * p[1] - y * p[0]]
    along = (1 - c) * sum(a * b for a, b in zip(AXIS, p))
    return [c * p[i] + s * cross[i] + along * AXIS[i] + cm / 100 * ALONG[i] for i in range(3)]


def turned(q, v):
    w, x, y, z = q
    t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])]
    return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2], v[2] + w * t[2] + x * t[1] - y * t[0]]


def by_matrix(m):
    return lambda p: [sum(m[i][k] * p[k] for k in range(3)) + m[i][3] for i in range(3)]


def by_standpoint(project, cloud, name):
    run("underlay", project, "--add", cloud, "--name", name, "--at", "0,0,0")
    pose = run("underlay", project, "--register", name, "--icp")["registered"]["pose"]
    return lambda p: [a + b for a, b in zip(turned(pose["rotation"], p), pose["translation"])]


def by_cloudcompare(model, cloud, folder):
    for old in glob.glob(f"{folder}/*REGISTRATION_MATRIX*.txt"):
        os.remove(old)
    subprocess.run(["CloudCompare", "-SILENT", "-AUTO_SAVE", "OFF", "-O", cloud, "-O", model, "-ICP", "-ITER", "200", "-MIN_ERROR_DIFF",
                    "1e-9", "-OVERLAP", "95", "-RANDOM_SAMPLING_LIMIT", "60000"],
                   env={**os.environ, "QT_QPA_PLATFORM": "offscreen"}, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    found = glob.glob(f"{folder}/*REGISTRATION_MATRIX*.txt")
    return by_matrix([list(map(float, line.split())) for line in open(found[0]) if line.strip()])


def by_open3d(model, cloud):
    try:
        import numpy, open3d
    except ImportError:
        return None
    surface = open3d.io.read_triangle_mesh(model)
    surface.compute_triangle_normals()
    target = surface.sample_points_uniformly(400000, use_triangle_normal=True)
    source, matrix = open3d.io.read_point_cloud(cloud), numpy.eye(4)
    registration = open3d.pipelines.registration
    for reach in 0.5, 0.25, 0.1, 0.05, 0.03:
        matrix = registration.registration_icp(
            source, target, reach, matrix, registration.TransformationEstimationPointToPlane(registration.TukeyLoss(reach)),
            registration.ICPConvergenceCriteria(1e-9, 1e-9, 100)).transformation
    return by_matrix(matrix)


def main():
    words = [w for w in sys.argv[1:] if w != "--ideal"]
    more = ["--ideal"] if "--ideal" in sys.argv else []
    with tempfile.TemporaryDirectory() as folder:
        project, model = f"{folder}/p", f"{folder}/model.obj"
        if words:
            run("import", words[0], "-o", project, "--shift", "none")
            run("export", project, "-o", model)
        else:
            write_room(model)
            run("import", model, "-o", project, "--shift", "none", "--up", "z", "--unit", "m")
        run("materials", project, *([] if words else ["--assign", "name:*=plaster_gypsum"]))
        points = scanned(project, folder, words[1:] or ["6,1.7", "1,5.5"], more)
        low, high = [min(p[i] for p in points) for i in range(3)], [max(p[i] for p in points) for i in range(3)]
        corners = [list(c) for c in itertools.product(*zip(low, high))]
        print(f"{len(points)} points, box {[round(b - a, 1) for a, b in zip(low, high)]} m; mm left at the corners, at most")
        for n, motion in enumerate(MOTIONS):
            cloud = f"{folder}/moved{n}.xyz"
            with open(cloud, "w") as file:
                file.writelines("%.6f %.6f %.6f\n" % tuple(moved(p, motion)) for p in points)
            backs = {"standpoint": by_standpoint(project, cloud, f"moved{n}"), "cloudcompare": by_cloudcompare(model, cloud, folder),
                     "open3d": by_open3d(model, cloud)}
            left = {who: 1000 * max(math.dist(back(moved(c, motion)), c) for c in corners) for who, back in backs.items() if back}
            before = 1000 * max(math.dist(moved(c, motion), c) for c in corners)
            print(f"{motion[0]} cm, {motion[1]}°: {before:.0f} before; " + ", ".join(f"{who} {mm:.2f}" for who, mm in left.items()), flush=True)


main()
