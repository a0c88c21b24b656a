# SPDX-License-Identifier: GPL-3.0-or-later
"""What scripts of this folder share: running the program, boxes to scan, and the points that it writes."""
import json
import os
import subprocess
import sys
import tempfile

import numpy as np

NUMBERS = {"double": "<f8", "float": "<f4", "uchar": "u1", "ushort": "<u2", "uint": "<u4", "int": "<i4", "short": "<i2", "char": "i1"}


def run(*words, losing=False, folder=None):
    """What it prints; ends the script where it fails. `losing`: it may lose data."""
    done = subprocess.run(words, cwd=folder, capture_output=True, text=True)
    if done.returncode != 0 and not (losing and done.returncode == 3):
        sys.exit(f"{' '.join(words)}\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
    return done.stdout


def measured(*words, folder=None):
    """Its answer as JSON, the processor's seconds and the most memory in MB of a process; ends the script where it fails."""
    with tempfile.TemporaryFile("w+") as answer, tempfile.TemporaryFile("w+") as errors:
        process = subprocess.Popen([*words, "--json"], cwd=folder, stdout=answer, stderr=errors)
        _, status, used = os.wait4(process.pid, 0)
        for said in (answer, errors):
            said.seek(0)
        if os.waitstatus_to_exitcode(status) != 0:
            sys.exit(" ".join(words) + "\n" + answer.read()[-2000:] + errors.read()[-2000:])
        return json.load(answer), used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def boxes_as_obj(boxes, material=None):
    """An OBJ of upright boxes, each with a name and two corners: the least and the greatest x, y and z."""
    text = []
    for number, (name, a, b) in enumerate(boxes):
        text.append(f"o {name}{number}")
        if material:
            text.append(f"usemtl {material}")
        for z in (a[2], b[2]):
            for x, y in ((a[0], a[1]), (b[0], a[1]), (b[0], b[1]), (a[0], b[1])):
                text.append(f"v {x:.6f} {y:.6f} {z:.6f}")
        at = 8 * number + 1
        for face in ((3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)):
            text.append("f " + " ".join(str(at + v) for v in face))
    return "\n".join(text) + "\n"


def read_ply(file):
    """Columns of one of our binary PLYs, without their "scalar_", and the scanner's pose: x y z, quaternion w x y z."""
    with open(file, "rb") as data:
        kinds, pose = [], np.array([0, 0, 0, 1, 0, 0, 0], float)
        for line in iter(data.readline, b"end_header\n"):
            words = line.decode().split()
            if words[:3] == ["comment", "standpoint", "pose"]:
                pose = np.array(words[3:10], float)
            elif words[:2] == ["element", "vertex"]:
                count = int(words[2])
            elif words[0] == "property" and words[1] != "list":
                kinds.append((words[2].replace("scalar_", ""), NUMBERS[words[1]]))
        return np.fromfile(data, np.dtype(kinds), count), pose
