#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# headless.sh FILE...: the main job without a display. Leaves in out/: job.json (replay it with `standpoint run`), project/,
# scan.e57, report.json and pictures/ of the editor. STANDPOINT_BIN: folder of the programs, if not that of the build.
set -euo pipefail
cd "$(dirname "$0")/.."
bin=${STANDPOINT_BIN:-$PWD/build/release/bin}
mkdir -p out
cd out
rm -rf project pictures scan.e57 report.json job.json
quoted=$(printf '"%s",' "$@")
cat >job.json <<JOB
[
  {"verb": "import", "files": [${quoted%,}], "output": "project"},
  {"verb": "optimize", "project": "project", "budget": 60000},
  {"verb": "collide", "project": "project"},
  {"verb": "materials", "project": "project"},
  {"verb": "georeference", "project": "project"},
  {"verb": "station", "project": "project", "add": "S1"},
  {"verb": "station", "project": "project", "add": "S2"},
  {"verb": "scan", "project": "project", "instrument": "leica-rtc360", "set": ["resolution=12mm"], "seed": 1, "output": "scan.e57"}
]
JOB
"$bin/standpoint" run job.json --allow-loss --json >report.json || { status=$?; cat report.json >&2; exit $status; }
"$bin/standpoint-editor" --pictures pictures project
echo "There is no display, so the main job ran without the editor's window. It left in out/:"
ls -1 project/project.json scan.e57 report.json job.json pictures/*.png
