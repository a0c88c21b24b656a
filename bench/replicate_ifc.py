#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a large IFC from a real one: copies of its records with new numbers and GlobalIds, side by side in a grid, under one IfcProject.

usage: replicate_ifc.py IN.ifc OUT.ifc MEGABYTES [STEP]      STEP: distance of the copies in the file's length unit (default 100000)

Then: standpoint import OUT.ifc -o PROJECT --allow-loss
"""
import hashlib
import math
import re
import sys

RECORD = re.compile(r"#(\d+)\s*=\s*([A-Za-z0-9_]+)\s*(\(.*?\))\s*;(?=\s*(?:#|ENDSEC|/\*))", re.S)
REFERENCE = re.compile(r"'(?:[^']|'')*'|#(\d+)")
GLOBAL_ID = re.compile(r"^\(\s*'[0-9A-Za-z_$]{22}'")
ALPHABET = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$"


def global_id(copy, number):
    """22 characters that name this record of this copy and no other; the first holds two bits only."""
    bits = int.from_bytes(hashlib.sha256(f"{copy}/{number}".encode()).digest()[:16], "big")
    return "".join(ALPHABET[bits >> 6 * k & 63] for k in range(21, -1, -1))


def renumbered(arguments, shift, project, first_project):
    def number(match):
        if match.group(1) is None:
            return match.group(0)
        n = int(match.group(1))
        return f"#{first_project if n == project else n + shift}"
    return REFERENCE.sub(number, arguments)


def coordinates(text):
    return [float(x) for x in re.findall(r"[-+0-9.Ee]+", text)]


def moved_roots(records):
    """For each placement without a parent: what must be written so that its copy stands elsewhere."""
    roots = {}
    for number, (name, arguments) in records.items():
        match = re.match(r"\(\s*\$\s*,\s*#(\d+)\s*\)$", arguments) if name.upper() == "IFCLOCALPLACEMENT" else None
        axis = match and records.get(int(match.group(1)))
        if not axis or axis[0].upper() != "IFCAXIS2PLACEMENT3D":
            continue
        point, rest = re.match(r"\(\s*#(\d+)\s*,(.*)\)$", axis[1], re.S).groups()
        if int(point) in records:
            roots[number] = (coordinates(records[int(point)][1]), rest)
    return roots


def main():
    source, target, megabytes = sys.argv[1], sys.argv[2], float(sys.argv[3])
    step = float(sys.argv[4]) if len(sys.argv) > 4 else 100000.0
    text = open(source, encoding="latin-1").read()
    begin = re.search(r"\bDATA\s*;", text).end()
    records = {int(m.group(1)): (m.group(2), m.group(3)) for m in RECORD.finditer(text, begin)}
    project = next(n for n, (name, _) in records.items() if name.upper() == "IFCPROJECT")
    roots = moved_roots(records)
    stride = max(records) + 2 * len(roots) + 1
    copies = max(1, math.ceil(megabytes * 1e6 / (len(text) - begin)))
    side = math.ceil(math.sqrt(copies))
    with open(target, "w", encoding="latin-1") as out:
        out.write(text[:begin] + "\n")
        for copy in range(copies):
            shift, spare = copy * stride, copy * stride + max(records)
            for number, (name, arguments) in records.items():
                if copy > 0 and number == project:
                    continue
                own = renumbered(GLOBAL_ID.sub(f"('{global_id(copy, number)}'", arguments), shift, project, project)
                if number in roots:
                    (x, y, z), rest = (roots[number][0] + [0.0, 0.0, 0.0])[:3], roots[number][1]
                    point, axis = spare + 1, spare + 2
                    spare += 2
                    out.write(f"#{point}=IFCCARTESIANPOINT(({x + copy % side * step!r},{y + copy // side * step!r},{z!r}));\n")
                    out.write(f"#{axis}=IFCAXIS2PLACEMENT3D(#{point},{renumbered(rest, shift, project, project)});\n")
                    own = f"($,#{axis})"
                out.write(f"#{number + shift}={name}{own};\n")
        out.write("ENDSEC;\nEND-ISO-10303-21;\n")
    print(f"{copies} copies of {len(records)} records")


main()
