#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A wind turbine that turns before four synchronous range meters, and the torsion of its blades that comes out of them.
Needs Debian's python3-numpy and python3-matplotlib.

usage: turbine.py STANDPOINT OUTDIR

The turbine and the places of the meters are written here; Standpoint imports, turns the rotor and scans. 1D: each meter
(instrument range-meter, 50 kHz) stands still and waits for the blade at its own radius; chord by chord, a straight line
through depth over chord is the torsion. 2D: a mirror of 100 Hz in the upright plane (profile-scanner, 500 kHz). Blades
truly twist by 4 degrees to their tips. The figures of both instruments are stand-ins: 2 mm, 0.2 mrad.
"""
import math
import os
import shutil
import sys

import numpy as np

from own_points import read_ply, run

RATE, HUB, TIP, CHORD, THICK, TWIST = 1.2, np.array([0, 0, 120.0]), 60.0, 2.0, 0.08, math.radians(4)
METERS, RADII, SECONDS = np.array([-180.0, 0, 2]), (20, 30, 40, 50), 20.0


def turned(points, angle):
    """About the rotor's axis, x, by a right hand."""
    c, s = math.cos(angle), math.sin(angle)
    return points @ np.array([[1, 0, 0], [0, c, s], [0, -s, c]])


def turbine():
    lines, vertices = [], 0

    def solid(name, rings):
        """A closed body of rings with as many corners each."""
        nonlocal vertices
        lines.append(f"o {name}\nusemtl Blade")
        sides = len(rings[0])
        for x, y, z in np.concatenate(rings):
            lines.append(f"v {x:.6f} {y:.6f} {z:.6f}")
        at = lambda ring, k: vertices + 1 + ring * sides + k % sides
        for ring in range(len(rings) - 1):
            for k in range(sides):
                lines.append(f"f {at(ring, k)} {at(ring, k + 1)} {at(ring + 1, k + 1)} {at(ring + 1, k)}")
        for ring, order in ((0, range(sides - 1, -1, -1)), (len(rings) - 1, range(sides))):
            lines.append("f " + " ".join(str(at(ring, k)) for k in order))
        vertices += len(rings) * sides

    def circle(centre, radius, u, v):
        angles = np.arange(16) * 2 * math.pi / 16
        return np.array(centre) + radius * (np.outer(np.cos(angles), u) + np.outer(np.sin(angles), v))

    x, y, z = np.eye(3)
    solid("Tower", [circle((6, 0, h), 3 - h / 120, x, y) for h in (0, 60, 117)])
    solid("Nacelle", [circle((d, 0, HUB[2]), 2.2, y, z) for d in (2, 11)])
    solid("Hub", [circle((d, 0, HUB[2]), r, y, z) for d, r in ((-1.5, 0.5), (-0.5, 1.6), (1.9, 1.6))])
    for blade in range(3):
        rings = []
        for radius in np.linspace(1.0, TIP, 119):
            twist = TWIST * radius / TIP
            along, out = np.array([math.sin(twist), math.cos(twist), 0]), np.array([-math.cos(twist), math.sin(twist), 0])
            corners = [s * along * CHORD / 2 + t * out * THICK / 2 for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            rings.append(turned(np.array(corners) + radius * z, 2 * math.pi / 3 * blade) + HUB)
        solid(f"Blade{blade + 1}", rings)
    return "mtllib turbine.mtl\n" + "\n".join(lines) + "\n"


def scan(standpoint, name, instrument, axis, angle, seconds, *more):
    """From where the meters stand, turned about x or y, for the time of a measurement."""
    x, y = (math.sin(angle / 2) if axis == which else 0.0 for which in "xy")
    with open(name + ".tum", "w") as file:
        for second in np.arange(0, seconds + 0.5):
            file.write(f"{second} {METERS[0]} {METERS[1]} {METERS[2]} {x:.15f} {y:.15f} 0 {math.cos(angle / 2):.15f}\n")
    run(standpoint, "scan", "p", "--trajectory", name + ".tum", "--trajectory-error", "none", "--instrument", instrument,
        "-o", name + ".ply", "--truth", *more)
    return read_ply(name + ".ply")[0]


def passes(points):
    """Each passage of a blade: its points in the blade's own frame, x depth, y chord, z radius."""
    time = points["Time"]
    order = np.argsort(time, kind="stable")
    for part in np.split(order, np.nonzero(np.diff(time[order]) > 0.2)[0] + 1):
        place = np.column_stack([points[axis][part] for axis in "xyz"]) - HUB
        back = np.empty_like(place)
        c, s = np.cos(RATE * time[part]), np.sin(RATE * time[part])  # turned back by what it had turned at its own time
        back[:, 0], back[:, 1], back[:, 2] = place[:, 0], c * place[:, 1] + s * place[:, 2], c * place[:, 2] - s * place[:, 1]
        middle = np.median(np.arctan2(-back[:, 1], back[:, 2]))
        back = turned(back, -2 * math.pi / 3 * round(middle / (2 * math.pi / 3)))
        if np.ptp(back[:, 1]) > CHORD - 0.1:  # not half over when it began, nor when it ended
            yield back


def torsion(blade):
    """Degrees, of a straight line of depth over chord; the mean radius; points. The narrow sides do not count."""
    blade = blade[np.abs(blade[:, 1]) < CHORD / 2 - 0.05]
    slope = np.polyfit(blade[:, 1], blade[:, 0], 1)[0]
    return math.degrees(math.atan(slope)), blade[:, 2].mean(), len(blade)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    standpoint, folder = os.path.abspath(sys.argv[1]), sys.argv[2]
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    os.chdir(folder)
    with open("turbine.obj", "w") as file:
        file.write(turbine())
    with open("turbine.mtl", "w") as file:
        file.write("newmtl Blade\nKd 0.85 0.85 0.85\n")
    run(standpoint, "import", "turbine.obj", "-o", "p", "--up", "z", "--allow-loss")
    run(standpoint, "materials", "p")
    parts = ("Blade1", "Blade2", "Blade3", "Hub")
    run(standpoint, "mover", "p", "--add", "rotor", "--kind", "turning", *(w for p in parts for w in ("--product", p)),
        "--axis-at", ",".join(str(v) for v in HUB), "--axis", "1,0,0", "--turn", repr(math.degrees(RATE)))

    print("1D: torsion at four radii, degrees")
    print("radius m   truth   ideal   noisy   one passage, sigma: found, expected   points")
    found = []
    for radius in RADII:
        aim = HUB + np.array([0, 0, radius]) - METERS
        pitch = -math.atan2(aim[2], aim[0])
        ideal = [torsion(b) for b in passes(scan(standpoint, f"ideal{radius}", "range-meter", "y", pitch, SECONDS, "--ideal"))]
        clouds = list(passes(scan(standpoint, f"noisy{radius}", "range-meter", "y", pitch, SECONDS)))
        noisy = [torsion(b) for b in clouds]
        angles = np.array([a for a, _, _ in noisy])
        count = np.mean([n for _, _, n in noisy])
        truth = math.degrees(TWIST) * np.mean([r for _, r, _ in ideal]) / TIP
        expected = math.degrees(0.002 * math.cos(pitch) * math.sqrt(12) / ((CHORD - 0.1) * math.sqrt(count)))
        found.append((radius, truth, angles, clouds[0]))
        print(f"{radius:8} {truth:7.3f} {np.mean([a for a, _, _ in ideal]):7.3f} {angles.mean():7.3f}"
              f"   {angles.std(ddof=1):19.4f} {expected:9.4f} {count:9.0f}")

    print("2D: profiles of a mirror of 100 Hz")
    profiles = scan(standpoint, "mirror", "profile-scanner", "x", math.pi / 2, 6.0, "--ideal")
    turn = np.floor(profiles["Time"] * 100)
    for radius in RADII:
        at = (np.abs(profiles["z"] - HUB[2] - radius) < 0.3) & (np.abs(profiles["x"]) < 1) & (profiles["Time"] > 0.5)
        count = len(np.unique(turn[at])) / max(1, len(np.unique(np.round(profiles["Time"][at] * RATE / (2 * math.pi / 3)))))
        print(f"{radius:8} m: {count:.2f} lines on a blade, chord / (omega r / f) {CHORD / (RATE * radius / 100):.2f}")
    picture(found)


def picture(found):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.2), constrained_layout=True)
    for radius, _, _, blade in found:
        left.plot(blade[:, 1], 1000 * blade[:, 0], ".", ms=1.5, label=f"{radius} m")
    left.set(xlabel="chord, m", ylabel="depth, mm", title="One passage at four radii")
    left.legend(markerscale=6, frameon=False, title="radius")
    right.plot([0, TIP], [0, math.degrees(TWIST)], color="0.6", label="the blade's twist")
    right.errorbar([r for r, *_ in found], [a.mean() for _, _, a, _ in found], yerr=[3 * a.std(ddof=1) for _, _, a, _ in found],
                   fmt="o", ms=4, capsize=3, label="from four meters, 3 sigma of a passage")
    right.set(xlabel="radius, m", ylabel="torsion, degrees", title="Torsion", xlim=(0, TIP), ylim=(0, None))
    right.legend(frameon=False)
    figure.savefig("turbine.png", dpi=110)


if __name__ == "__main__":
    main()
