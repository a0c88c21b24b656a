#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a critical eye looks for: a mesh fence, a picture rail and fog, scanned and drawn. Debian's python3-matplotlib.

usage: thin_things.py STANDPOINT OUTDIR      (writes the scene, scans it and leaves fence.png, rail.png and fog.png)
"""
import os
import sys

import numpy as np
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from own_points import read_ply, run  # noqa: E402

FENCE_M, WALL_M, RAIL_M = 8.0, 12.0, 5.0  # from the station


def box(low, high):
    x, y, z = zip(low, high)
    corners = [(x[i & 1], y[i >> 1 & 1], z[i >> 2 & 1]) for i in range(8)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return corners, faces


def write_scene(folder):
    """Floor, a wall behind a mesh fence (rods of 5 mm every 50 mm, of 6 mm every 200 mm), a wall with a picture rail of
    20 × 40 mm at 2.2 m."""
    things = [("floor", "Concrete", box((-RAIL_M, -2, -0.1), (70, 70, 0))),
              ("back", "Plaster", box((-RAIL_M, WALL_M, 0), (4, WALL_M + 0.2, 3))),
              ("side", "Plaster", box((-RAIL_M - 0.2, -2, 0), (-RAIL_M, WALL_M, 3))),
              ("rail", "Wood", box((-RAIL_M, 1, 2.2), (-RAIL_M + 0.02, WALL_M - 1, 2.24))),
              ("far", "Plaster", box((66, -5, 0), (66.2, 5, 6)))]
    for i in range(41):
        x = -1 + 0.05 * i
        things.append((f"rod {i}", "Steel", box((x - 0.0025, FENCE_M - 0.0025, 0.05), (x + 0.0025, FENCE_M + 0.0025, 1.85))))
    for i in range(10):
        z = 0.05 + 0.2 * i
        things.append((f"bar {i}", "Steel", box((-1, FENCE_M - 0.009, z - 0.003), (1, FENCE_M - 0.003, z + 0.003))))
    for i in range(2):
        x = -1 + 2 * i
        things.append((f"post {i}", "Steel", box((x - 0.03, FENCE_M, 0), (x + 0.03, FENCE_M + 0.04, 2))))
    lines, count = ["mtllib thin.mtl"], 0
    for name, material, (corners, faces) in things:
        lines += [f"o {name}", f"usemtl {material}"] + ["v %.6f %.6f %.6f" % c for c in corners]
        lines += ["f " + " ".join(str(count + k + 1) for k in face) for face in faces]
        count += len(corners)
    with open(os.path.join(folder, "thin.obj"), "w") as file:
        file.write("\n".join(lines) + "\n")
    with open(os.path.join(folder, "thin.mtl"), "w") as file:
        for name, grey in (("Concrete", 0.5), ("Plaster", 0.8), ("Wood", 0.4), ("Steel", 0.5)):
            file.write(f"newmtl {name}\nKd {grey} {grey} {grey}\n")


def scan(standpoint, folder, name, instrument, settings, *more):
    """Points of a scan from (0, 0, 1.6), with their flags, as columns of numbers."""
    file = os.path.join(folder, name)
    for old in (file + ".e57", file + ".ply"):
        if os.path.exists(old):
            os.remove(old)
    run(standpoint, "scan", "p", "--instrument", instrument, "--set", *settings, "--truth", "-o", name + ".e57", *more, folder=folder)
    run(standpoint, "convert", name + ".e57", name + ".ply", folder=folder)
    return read_ply(file + ".ply")[0]


def draw_fence(standpoint, folder):
    window = ["resolution=6mm", "field_of_view=target_area", "horizontal_from=262", "horizontal_to=278",
              "vertical_from=-10", "vertical_to=2"]
    figure, axes = plt.subplots(2, 3, figsize=(16, 8.5), sharex="col")
    for column, quality in enumerate(("preview", "default", "reference")):
        points = scan(standpoint, folder, "fence-" + quality, "leica-rtc360", window, "--quality", quality)
        x, y, z = points["x"], points["y"], points["z"]
        fence = y < FENCE_M + 1.5
        order = np.argsort(-y)
        axes[0, column].scatter(x[order], z[order], c=y[order], s=0.4, cmap="viridis", vmin=FENCE_M - 0.2, vmax=WALL_M)
        axes[0, column].set(title=f"--quality {quality}: {np.count_nonzero(fence)} points on the fence", xlim=(-1.1, 0.1),
                            ylim=(0.2, 1.4), aspect="equal")
        axes[1, column].scatter(x, y, c="k", s=0.3)
        axes[1, column].set(xlim=(-1.1, 0.1), ylim=(FENCE_M - 0.5, WALL_M + 0.5), xlabel="x (m)")
    axes[0, 0].set_ylabel("z (m)")
    axes[1, 0].set_ylabel("from above: y (m)")
    figure.suptitle("Rods of 5 mm every 50 mm at 8 m before a wall at 12 m; RTC360, 6 mm at 10 m")
    figure.tight_layout()
    figure.savefig(os.path.join(folder, "fence.png"), dpi=65)


def draw_rail(standpoint, folder):
    figure, axes = plt.subplots(1, 2, figsize=(11, 8), sharey=True)
    for axis, (instrument, settings) in zip(axes, (
            ("leica-rtc360", ["resolution=3mm", "field_of_view=target_area", "horizontal_from=195",
                              "horizontal_to=220", "vertical_from=0", "vertical_to=15"]),
            ("zf-imager-5016", ["resolution=high"]))):
        points = scan(standpoint, folder, "rail-" + instrument, instrument, settings)
        near = (points["x"] < -RAIL_M + 0.2) & (np.abs(points["y"] - 2.5) < 0.15) & (np.abs(points["z"] - 2.22) < 0.08)
        part = points[near]
        axis.plot([-RAIL_M, -RAIL_M, -RAIL_M + 0.02, -RAIL_M + 0.02, -RAIL_M, -RAIL_M], [2.14, 2.2, 2.2, 2.24, 2.24, 2.3],
                  "r-", lw=1, label="model")
        axis.scatter(part["x"], part["z"], s=2, c="k")
        axis.set(title=f"{instrument}: {len(part)} points of 30 cm", xlabel="x (m)", aspect="equal", xlim=(-5.04, -4.94))
        axis.legend(loc="center left")
    axes[0].set_ylabel("z (m)")
    figure.suptitle("A picture rail of 20 × 40 mm at 5.6 m, in section")
    figure.tight_layout()
    figure.savefig(os.path.join(folder, "rail.png"), dpi=65)


def draw_fog(standpoint, folder):
    window = ["resolution=12mm", "field_of_view=target_area", "horizontal_from=0", "horizontal_to=4", "vertical_from=-12",
              "vertical_to=6"]
    figure, axes = plt.subplots(3, 1, figsize=(13, 10), sharex=True)
    for axis, fog in zip(axes, (None, 150, 70)):
        more = [] if fog is None else ["--weather", f"fog={fog}"]
        points = scan(standpoint, folder, f"fog-{fog}", "leica-rtc360", window, *more)
        weather = (points["Flags"] & 8) != 0
        axis.scatter(points["x"][~weather], points["z"][~weather], s=0.3, c="0.4", label="surfaces")
        axis.scatter(points["x"][weather], points["z"][weather], s=0.6, c="tab:blue", label="fog")
        farthest = points["x"][~weather].max() if np.any(~weather) else 0
        axis.set(title=f"{'clear air' if fog is None else f'fog, visibility {fog} m'}: {np.count_nonzero(weather)} of "
                       f"{len(points)} points are the air's; the farthest surface is at {farthest:.1f} m", ylim=(-1, 9),
                 xlim=(0, 70), ylabel="z (m)")
        axis.legend(loc="upper center", markerscale=8)
    axes[-1].set_xlabel("x (m)")
    figure.tight_layout()
    figure.savefig(os.path.join(folder, "fog.png"), dpi=65)


def main():
    standpoint, folder = os.path.realpath(sys.argv[1]), sys.argv[2]
    os.makedirs(folder, exist_ok=True)
    write_scene(folder)
    if not os.path.exists(os.path.join(folder, "p")):
        run(standpoint, "import", "thin.obj", "-o", "p", "--up", "z", "--allow-loss", folder=folder)
        run(standpoint, "station", "p", "--add", "S1", "--at", "0,0,1.6", folder=folder)
        run(standpoint, "materials", "p", folder=folder)
    draw_fence(standpoint, folder)
    draw_rail(standpoint, folder)
    draw_fog(standpoint, folder)


if __name__ == "__main__":
    main()
