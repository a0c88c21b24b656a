#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How many of the volumes that IFC files state themselves the importer meets.

usage: authored_volumes.py STANDPOINT CORPUS_IFC      CORPUS_IFC holds authored_volumes.jsonl and the files that it names

Prints the share within 1 %, then with a micro cubic metre of slack (the files round), then each file with the volumes that
are not met, grouped by class and by the deviation in per cent.
"""
import collections
import json
import os
import subprocess
import sys
import tempfile

program, corpus = sys.argv[1:3]
stated = collections.defaultdict(list)
for line in open(os.path.join(corpus, "authored_volumes.jsonl")):
    row = json.loads(line)
    stated[row["file"]].append(row)

met = nearly = total = 0
poor = {}
for name, rows in stated.items():
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.run([program, "import", os.path.join(corpus, name), "-o", folder + "/p", "--json", "--allow-loss"], capture_output=True)
    try:
        volumes = {p["id"].lstrip("#"): p["volume"] for p in json.loads(run.stdout)["products"]}
    except (ValueError, KeyError):
        volumes = {}
    missed = collections.Counter()
    for row in rows:
        total += 1
        ours, theirs = volumes.get(str(row["id"])), row["volume_m3"]
        if ours is not None and abs(ours / theirs - 1) <= 0.01:
            met += 1
            nearly += 1
            continue
        if ours is not None and abs(ours - theirs) <= 1e-6:
            nearly += 1
        missed[row["class"], "none" if ours is None else f"{(ours / theirs - 1) * 100:+.1f} %"] += 1
    if missed:
        poor[name] = missed

print(f"{met} of {total} within 1 % ({met / total:.4f}), {nearly} within 1 % or 1e-6 m3 ({nearly / total:.4f})")
for name, missed in sorted(poor.items()):
    print(name, ", ".join(f"{count} {kind} {deviation}" for (kind, deviation), count in missed.most_common()))
