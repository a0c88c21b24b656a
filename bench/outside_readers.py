#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Do other programs find the points that we wrote, in each place? Writes a scan in every format and lets others read it.

    bench/outside_readers.py STANDPOINT SCAN.e57 WORK [NPM]

SCAN.e57 has one station or several, WORK is a new folder. Readers, each left out with a line where it is not there: CloudCompare
(Debian's cloudcompare) for PTX, PTS, XYZ, CSV and PLY, Open3D (python3-open3d) for PLY, PCD, PTS and XYZ, and from NPM, a folder
where `npm install web-e57@1.2.0 copc@0.0.8 @loaders.gl/core @loaders.gl/ply @loaders.gl/pcd` was done, web-e57 for E57, copc for
LAS, loaders.gl for PLY and PCD. The points are compared one by one in the file's frame with what web-e57 finds in SCAN.e57 itself,
or without it with our XYZ, to the tolerance that the format's digits and the reader's numbers allow. Exit 1 where one differs.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys

import numpy as np

WEB_E57 = """
import fs from 'node:fs';
const dir = process.argv[2] + '/node_modules/web-e57/';
const glue = await import('file://' + dir + 'e57_bg.js');
const made = await WebAssembly.instantiate(fs.readFileSync(dir + 'e57_bg.wasm'), {'./e57_bg.js': glue});
glue.__wbg_set_wasm(made.instance.exports);
fs.writeFileSync(process.argv[4], glue.convertE57(new Uint8Array(fs.readFileSync(process.argv[3])), 'XYZ'));
"""
COPC = """
import fs from 'node:fs';
import { createRequire } from 'node:module';
const { Las } = createRequire(process.argv[2] + '/')('copc');
const bytes = fs.readFileSync(process.argv[3]);
const header = Las.Header.parse(bytes);
const body = bytes.subarray(header.pointDataOffset, header.pointDataOffset + header.pointCount * header.pointDataRecordLength);
const view = Las.View.create(body, header), get = ['X', 'Y', 'Z'].map(view.getter);
const places = new Float64Array(3 * header.pointCount);
for (let i = 0; i < header.pointCount; ++i) for (let k = 0; k < 3; ++k) places[3 * i + k] = get[k](i);
fs.writeFileSync(process.argv[4], Buffer.from(places.buffer));
"""
LOADERS = """
import fs from 'node:fs';
import { createRequire } from 'node:module';
const require = createRequire(process.argv[2] + '/'), bytes = fs.readFileSync(process.argv[3]);
const { parse } = require('@loaders.gl/core'), { PLYLoader } = require('@loaders.gl/ply'), { PCDLoader } = require('@loaders.gl/pcd');
const whole = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
const cloud = await parse(whole, process.argv[3].endsWith('.ply') ? PLYLoader : PCDLoader, { worker: false });
fs.writeFileSync(process.argv[4], Buffer.from(Float64Array.from(cloud.attributes.POSITION.value).buffer));
"""


class Absent(Exception):
    pass


def run(*words, **more):
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True, **more)
    if done.returncode != 0:
        raise RuntimeError(f"{words[0]}: {(done.stderr or done.stdout)[-400:]}")
    return done.stdout


def text_places(file):
    """The first three numbers of each line; lines of words are passed by."""
    rows = []
    for line in open(file):
        words = line.replace(",", " ").split()
        try:
            rows.append([float(w) for w in words[:3]])
        except ValueError:
            continue
    return np.array(rows).reshape(-1, 3)


def by_node(script, npm, package, file, text=False):
    if npm is None or not (npm / "node_modules" / package).is_dir() or not shutil.which("node"):
        raise Absent(f"npm {package}")
    code, out = file.with_suffix(".mjs"), file.with_suffix(".read")
    code.write_text(script)
    run("node", "--max-old-space-size=8192", code, npm, file, out)
    return text_places(out) if text else np.fromfile(out).reshape(-1, 3)


def by_cloudcompare(file):
    if not shutil.which("CloudCompare"):
        raise Absent("CloudCompare")
    folder = file.parent / "cc"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    copy = shutil.copy(file, folder)
    run("CloudCompare", "-SILENT", "-AUTO_SAVE", "OFF", "-C_EXPORT_FMT", "ASC", "-PREC", "6", "-NO_TIMESTAMP", "-O", "-GLOBAL_SHIFT",
        "AUTO", copy, "-MERGE_CLOUDS" if file.suffix == ".ptx" else "-APPLY_TRANS", *([] if file.suffix == ".ptx" else [identity(folder)]),
        "-SAVE_CLOUDS", env={**os.environ, "QT_QPA_PLATFORM": "offscreen", "HOME": str(folder)}, timeout=600)
    found = [f for f in folder.iterdir() if f.suffix == ".asc"]
    if len(found) != 1:
        raise RuntimeError(f"CloudCompare wrote {len(found)} clouds")
    return text_places(found[0])


def identity(folder):
    (folder / "identity.txt").write_text("1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n")
    return folder / "identity.txt"


def by_open3d(file):
    try:
        import open3d
    except ImportError:
        raise Absent("Open3D")
    return open3d.t.io.read_point_cloud(str(file)).point["positions"].numpy().astype(float)


def posed(file, places):
    """A PCD's points stand in the frame of its VIEWPOINT; cells without a point are NaN."""
    places = places[np.isfinite(places).all(1)]
    with open(file, "rb") as lines:
        view = next(line for line in lines if line.startswith(b"VIEWPOINT"))
    x, y, z, qw, qx, qy, qz = (float(w) for w in view.split()[1:])
    turn = np.array([[1 - 2 * (qy * qy + qz * qz), 2 * (qx * qy - qz * qw), 2 * (qx * qz + qy * qw)],
                     [2 * (qx * qy + qz * qw), 1 - 2 * (qx * qx + qz * qz), 2 * (qy * qz - qx * qw)],
                     [2 * (qx * qz - qy * qw), 2 * (qy * qz + qx * qw), 1 - 2 * (qx * qx + qy * qy)]])
    return places @ turn.T + [x, y, z]


def main():
    if len(sys.argv) not in (4, 5):
        sys.exit(__doc__)
    standpoint, scan, work = (pathlib.Path(a).resolve() for a in sys.argv[1:4])
    npm = pathlib.Path(sys.argv[4]).resolve() if len(sys.argv) == 5 else None
    work.mkdir(parents=True)

    def written(name, *more):
        """The files that a conversion makes: one, or one of each station."""
        said = run(standpoint, "convert", scan, work / name, "--json", "--allow-loss", *more)
        return [pathlib.Path(f) for f in json.loads(said)["files"]]

    # format, how it is written, reader's name, reader, what a place may differ by: half a step of the text or the integer
    # (along an axis that is turned: 0.087 mm), and what a single float of this size leaves where the reader keeps no others;
    # CloudCompare moves far coordinates before it does.
    right = None
    try:
        right = by_node(WEB_E57, npm, "web-e57", pathlib.Path(shutil.copy(scan, work / "scan.e57")), text=True)
        source = "web-e57"
    except Absent:
        right, source = np.concatenate([text_places(f) for f in written("right.xyz")]), "our XYZ"
    single = np.abs(right).max() * 2.0 ** -23
    print(f"{len(right)} points by {source}, farthest coordinate {np.abs(right).max():.3f} m")
    node = lambda script, package, text=False: lambda file: by_node(script, npm, package, file, text)
    web, copc, loaders = node(WEB_E57, "web-e57", True), node(COPC, "copc"), node(LOADERS, "@loaders.gl/core")
    cases = [("e57", (), "web-e57", web, 2e-6), ("e57", ("--as", "scaled"), "web-e57", web, 9e-5),
             ("e57", ("--as", "spherical"), "web-e57", web, 2e-5), ("las", (), "copc", copc, 5.1e-5),
             ("las", ("--as", "pdrf8"), "copc", copc, 5.1e-5),
             *((e, (), "CloudCompare", by_cloudcompare, 1.2e-5) for e in ("ptx", "pts", "xyz", "csv", "ply")),
             ("ply", (), "Open3D", by_open3d, 2e-6),
             *((e, (), "Open3D", by_open3d, 6e-6 + single) for e in ("pts", "xyz")),
             ("pcd", (), "Open3D", by_open3d, 2e-6), ("pcd", ("--as", "points"), "Open3D", by_open3d, 2e-6),
             ("ply", (), "loaders.gl", loaders, single), ("pcd", (), "loaders.gl", loaders, 2e-6)]
    wrong = 0
    for extension, how, reader, read, tolerance in cases:
        label = f"{extension} {' '.join(how[1:])}".strip()
        try:
            files = written("written." + extension, *how)
            places = np.concatenate([posed(f, read(f)) if extension == "pcd" else read(f) for f in files])
        except Absent as missing:
            print(f"{label:14} {reader:13} not here: {missing}")
            continue
        except (RuntimeError, StopIteration) as error:
            wrong += 1
            print(f"{label:14} {reader:13} FAILED: {error}")
            continue
        same = len(places) == len(right)
        worst = np.abs(places - right).max() if same and len(right) else 0 if same else np.inf
        good = same and worst <= tolerance
        wrong += not good
        print(f"{label:14} {reader:13} {len(places)} points, at most {1000 * worst:.4f} mm off (allowed {1000 * tolerance:.4f}) "
              f"{'as it should be' if good else 'DIFFERS'}")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
