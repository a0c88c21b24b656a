#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whole-process time and peak memory of `standpoint import` beside web-ifc in node, alternating, median of three.

usage: bench/import_beside_webifc.py STANDPOINT WEBIFC FILE.ifc...
  WEBIFC is a folder in which `npm install web-ifc` was run. web-ifc opens the file and makes every mesh; ours also reads the
  properties and writes the project. Prints a line for each file, then the median and the worst ratio (ours / theirs).
"""
import os
import statistics
import subprocess
import sys
import tempfile
import time

THEIRS = r"""
const W = require(process.argv[3] + '/node_modules/web-ifc/web-ifc-api-node.js'), fs = require('fs');
(async () => {
  const api = new W.IfcAPI(); await api.Init(); api.SetLogLevel(4);
  const model = api.OpenModel(new Uint8Array(fs.readFileSync(process.argv[2])), { COORDINATE_TO_ORIGIN: false });
  let triangles = 0;
  api.StreamAllMeshes(model, mesh => {
    for (let i = 0; i < mesh.geometries.size(); i++)
      triangles += api.GetGeometry(model, mesh.geometries.get(i).geometryExpressID).GetIndexDataSize() / 3;
  });
  console.log(triangles); process.exit(0);
})();
"""


def measure(command):
    """Seconds and peak resident MiB of one process; None when it failed."""
    start = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    return time.monotonic() - start, usage.ru_maxrss / 1024, os.waitstatus_to_exitcode(status)


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    standpoint, webifc, files = sys.argv[1], os.path.abspath(sys.argv[2]), sys.argv[3:]
    times, memories = [], []
    with tempfile.TemporaryDirectory() as work:
        script = os.path.join(work, "theirs.cjs")
        with open(script, "w") as out:
            out.write(THEIRS)
        print(f"{'file':48} {'ours s':>8} {'theirs s':>9} {'ratio':>6} {'ours MiB':>9} {'theirs MiB':>11} {'ratio':>6}")
        for file in files:
            ours, theirs = [], []
            for k in range(3):
                project = os.path.join(work, f"p{k}")
                ours.append(measure([standpoint, "import", file, "-o", project, "--replace", "--allow-loss"]))
                theirs.append(measure(["node", script, file, webifc]))
            if any(run[2] for run in ours + theirs):
                print(f"{os.path.basename(file):48} failed: ours {ours[0][2]}, theirs {theirs[0][2]}")
                continue
            seconds = [statistics.median(run[0] for run in runs) for runs in (ours, theirs)]
            memory = [statistics.median(run[1] for run in runs) for runs in (ours, theirs)]
            times.append(seconds[0] / seconds[1])
            memories.append(memory[0] / memory[1])
            print(f"{os.path.basename(file)[:48]:48} {seconds[0]:8.2f} {seconds[1]:9.2f} {times[-1]:6.2f}"
                  f" {memory[0]:9.0f} {memory[1]:11.0f} {memories[-1]:6.2f}")
    for name, ratios in (("time", times), ("memory", memories)):
        if ratios:
            print(f"{name}: median {statistics.median(ratios):.2f}, worst {max(ratios):.2f}")


main()
