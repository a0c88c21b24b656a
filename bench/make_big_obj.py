#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes OUT/big.obj and OUT/big.mtl: waves of 2 million triangles with v, vt and vn, 100 groups, 8 materials, about
200 MB, the same bytes each time. Usage: make_big_obj.py OUT [TRIANGLES]"""
import math
import pathlib
import sys

out = pathlib.Path(sys.argv[1])
triangles = int(sys.argv[2]) if len(sys.argv) > 2 else 2_000_000
groups = 100
side = max(1, round(math.sqrt(triangles / groups / 2)))  # quads along a group's edge
out.mkdir(parents=True, exist_ok=True)
with open(out / "big.mtl", "w") as mtl:
    for m in range(8):
        mtl.write(f"newmtl material_{m}\nKd {0.1 * m + 0.1:.2f} 0.5 {0.9 - 0.1 * m:.2f}\nKs 0.04 0.04 0.04\nNi 1.45\nd 1\nillum 2\n\n")
with open(out / "big.obj", "w") as obj:
    obj.write("mtllib big.mtl\n")
    base = 1
    for g in range(groups):
        obj.write(f"g group_{g}\nusemtl material_{g % 8}\n")
        x0, y0 = (g % 10) * 12.0, (g // 10) * 12.0
        for i in range(side + 1):
            lines = []
            for j in range(side + 1):
                u, v = i / side, j / side
                z = 0.2 * math.sin(9 * u + g) * math.cos(7 * v)
                dx, dy = 1.8 * math.cos(9 * u + g) * math.cos(7 * v), -1.4 * math.sin(9 * u + g) * math.sin(7 * v)
                n = 1 / math.sqrt(dx * dx + dy * dy + 1)
                lines.append(f"v {x0 + 10 * u:.6f} {y0 + 10 * v:.6f} {z:.6f}\nvt {u:.6f} {v:.6f}\nvn {-dx * n:.6f} {-dy * n:.6f} {n:.6f}\n")
            obj.write("".join(lines))
        for i in range(side):
            lines = []
            for j in range(side):
                a = base + i * (side + 1) + j
                b, c, d = a + side + 1, a + side + 2, a + 1
                lines.append(f"f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}\nf {a}/{a}/{a} {c}/{c}/{c} {d}/{d}/{d}\n")
            obj.write("".join(lines))
        base += (side + 1) ** 2
