#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Standpoint beside HELIOS++: thin wires, edges, rays, a trajectory and power, in scenes that both get from here. Needs
Debian's python3-numpy and python3-matplotlib, and a HELIOS++ that was built elsewhere.

usage: beside_helios.py STANDPOINT HELIOS OUTDIR [HOUSE.ifc [PART ...]]

HELIOS is its program helios++. PART is of: wires edges rays walk power (all). Each part prints its figures; edges
leaves a picture in OUTDIR. What HELIOS++ reads is written by `standpoint export` (the scene), `standpoint trajectory`
(the way) and here (scanner and survey).

HELIOS++ gets Standpoint's own grid of rays: a scanner of as many channels as the grid has rows, whose head turns on by
a column with each pulse. Its text output ends at 0.1 mm.
"""
import glob
import json
import math
import os
import shutil
import sys

import numpy as np

from own_points import read_ply, run

HERE = os.path.dirname(os.path.realpath(__file__))
INSTRUMENTS = os.path.join(HERE, "..", "scanners", "instruments")
QUIET = "range-noise,angle-noise,bias,striping,variation,amplitude-noise,quantisation,incidence-noise,range-offset," \
        "levelling,near-range,atmosphere,halo,saturation,multipath,textures"   # what is left: beam, detection, receiver


class Bench:
    def __init__(self, standpoint, helios, folder, house):
        self.standpoint, self.helios, self.folder, self.house = standpoint, helios, folder, house

    def run(self, *words, folder=None):
        return run(*words, folder=folder or self.folder)

    # ------------------------------------------------------------------------------------------ ours

    def project(self, name, model):
        """A project of an OBJ text or a model's file, and the same as a scene for HELIOS++."""
        place = os.path.join(self.folder, name)
        shutil.rmtree(place, ignore_errors=True)
        os.makedirs(place)
        if not os.path.exists(model):
            with open(os.path.join(place, "scene.obj"), "w") as file:
                file.write(model)
            with open(os.path.join(place, "scene.mtl"), "w") as file:
                file.write("newmtl Plaster\nKd 0.8 0.8 0.8\n")
            model = "scene.obj"
            self.run(self.standpoint, "import", model, "-o", "p", "--up", "z", "--allow-loss", folder=place)
        else:
            self.run(self.standpoint, "import", model, "-o", "p", folder=place)
        self.run(self.standpoint, "materials", "p", folder=place)
        os.makedirs(os.path.join(place, "helios"))
        self.run(self.standpoint, "export", "p", "-o", "helios/scene.xml", "--allow-loss", folder=place)
        return place

    def station(self, place, *where):
        self.run(self.standpoint, "station", "p", "--add", "S1", "--stand", "free", *where, folder=place)

    def instrument(self, place, base, name, change):
        with open(os.path.join(INSTRUMENTS, base + ".json")) as file:
            data = json.load(file)
        data["id"] = name
        change(data)
        with open(os.path.join(place, name + ".json"), "w") as file:
            json.dump(data, file)
        return name + ".json"

    def scan(self, place, instrument, *more):
        for old in glob.glob(os.path.join(place, "scan*")):
            os.remove(old)
        self.run(self.standpoint, "scan", "p", "--instrument", instrument, "--truth", "-o", "scan.e57", *more,
                 folder=place)
        self.run(self.standpoint, "convert", "scan.e57", "scan.ply", folder=place)
        return read_ply(os.path.join(place, "scan.ply"))

    # ---------------------------------------------------------------------------------------- theirs

    def helios_run(self, place, survey, *more):
        """Points of all channels: columns x y z intensity return returns pulse gps channel."""
        home = os.path.join(place, "helios")
        shutil.rmtree(os.path.join(home, "out"), ignore_errors=True)
        with open(os.path.join(home, "survey.xml"), "w") as file:
            file.write(survey)
        self.run(self.helios, "survey.xml", "--assets", home, "--output", "out", "--seed", "1", "--nthreads", "2",
                 "--rebuildScene", "--noSceneWriting", "--quiet", *more, folder=home)
        parts = []
        for file in sorted(glob.glob(os.path.join(home, "out", "**", "*points*.xyz"), recursive=True)):
            tail = os.path.basename(file)[:-4].rsplit("_", 1)[-1]
            digits = "".join(c for c in tail if c.isdigit())
            rows = read_points(file)
            parts.append(np.hstack([rows, np.full((len(rows), 1), int(digits) if digits else -1)]))
        return np.vstack(parts) if parts else np.empty((0, 9))

    def helios_grid(self, place, at, grid, divergence_rad, quality, pulse_ns=1.5, returns=0, bin_ns=0.02,
                    wavelength_nm=1550, min_m=0.1):
        """The rays of `grid` from `at`: (first azimuth, step, columns, elevations), anticlockwise from +x, radians."""
        first, step, columns, elevations = grid
        channels = "".join(channel(i, e) for i, e in enumerate(np.degrees(elevations).tolist()))
        write_scanner(place, "grid", channels, divergence_rad, quality, pulse_ns, returns, bin_ns, wavelength_nm, min_m)
        turn = math.degrees(step)                 # their body looks along y, and the head turns before it fires
        start = math.degrees(first) - 90 - turn
        survey = (f'<?xml version="1.0"?>\n<document>\n<scannerSettings id="s" active="true" pulseFreq_hz="1000" '
                  f'scanAngle_deg="1" scanFreq_hz="0" headRotatePerSec_deg="{turn * 1000!r}" '
                  f'headRotateStart_deg="{start!r}" headRotateStop_deg="{start + turn * (columns - 0.5)!r}" '
                  f'trajectoryTimeInterval_s="0"/>\n<survey name="grid" scene="scene.xml#scene" '
                  f'platform="platforms.xml#post" scanner="scanner.xml#grid">\n<leg>'
                  f'<platformSettings x="{at[0]!r}" y="{at[1]!r}" z="{at[2]!r}" onGround="false"/>'
                  f'<scannerSettings template="s"/></leg>\n</survey>\n</document>\n')
        return self.helios_run(place, survey)


def channel(number, elevation_deg, height_m=0.0):
    return (f'<channel id="{number}"><beamOrigin x="0" y="0" z="{height_m!r}"><rot axis="x" '
            f'angle_deg="{elevation_deg!r}"/></beamOrigin></channel>\n')


def write_scanner(place, name, channels, divergence_rad, quality, pulse_ns, returns, bin_ns, wavelength_nm, min_m):
    home = os.path.join(place, "helios")
    with open(os.path.join(home, "scanner.xml"), "w") as file:
        file.write(f'<?xml version="1.0"?>\n<document>\n<scanner id="{name}" name="{name}" accuracy_m="0" '
                   f'beamDivergence_rad="{divergence_rad!r}" optics="rotating" pulseFreqs_Hz="1000" '
                   f'pulseLength_ns="{pulse_ns!r}" rangeMin_m="{min_m!r}" rangeMax_m="1000" scanAngleMax_deg="1" '
                   f'scanAngleEffectiveMax_deg="1" scanFreqMin_Hz="0" scanFreqMax_Hz="0" '
                   f'headRotatePerSecMax_deg="1000000" wavelength_nm="{wavelength_nm}" maxNOR="{returns}">\n'
                   f'<headRotateAxis x="0" y="0" z="1"/>\n<FWFSettings beamSampleQuality="{quality}" '
                   f'binSize_ns="{bin_ns!r}" winSize_ns="{pulse_ns / 4!r}"/>\n<channels>\n'
                   f'{channels}</channels>\n</scanner>\n</document>\n')
    with open(os.path.join(home, "platforms.xml"), "w") as file:
        file.write('<?xml version="1.0"?>\n<document>\n<platform id="post" name="post" type="static">'
                   '<scannerMount x="0" y="0" z="0"/></platform>\n</document>\n')


def read_points(file):
    """x y z intensity return returns pulse time of one of their text files; its object's name is no number."""
    if os.path.getsize(file) == 0:
        return np.empty((0, 8))
    return np.loadtxt(file, usecols=(0, 1, 2, 3, 5, 6, 7, 10), ndmin=2)


def places(points, true=False):
    names = ("TrueX", "TrueY", "TrueZ") if true else ("x", "y", "z")
    return np.stack([points[n] for n in names], 1)


def grid_of(points, at):
    """First azimuth, step, columns and elevations of a scan without noise, from its points."""
    rays = places(points) - at
    rays /= np.linalg.norm(rays, axis=1)[:, None]
    columns, rows = points["Column"].astype(int), points["Row"].astype(int)
    upright = np.abs(rays[:, 2]) < 0.9
    order = np.argsort(columns[upright], kind="stable")
    turned = np.unwrap(np.arctan2(rays[upright, 1], rays[upright, 0])[order])
    step, first = np.polyfit(columns[upright][order], turned, 1)
    slope, level = np.polyfit(rows, np.arcsin(rays[:, 2]), 1)
    misfit = max(np.abs(turned - first - step * columns[upright][order]).max(),
                 np.abs(np.arcsin(rays[:, 2]) - level - slope * rows)[upright].max())
    return (first, step, columns.max() + 1, level + slope * np.arange(rows.max() + 1)), misfit


def row_and_column(rays, grid):
    first, step, columns, elevations = grid
    slope = elevations[1] - elevations[0]
    azimuth = np.arctan2(rays[:, 1], rays[:, 0])
    turns = np.round((first + step * columns / 2 - azimuth) / (2 * np.pi))
    column = (azimuth + 2 * np.pi * turns - first) / step
    row = (np.arcsin(rays[:, 2] / np.linalg.norm(rays, axis=1)) - elevations[0]) / slope
    return row, column


def window(azimuth_from, azimuth_to, elevation_from, elevation_to, resolution="6mm"):
    """Settings of the RTC360's window; its azimuths are clockwise from +x."""
    return ["--set", "resolution=" + resolution, "field_of_view=target_area", f"horizontal_from={azimuth_from}",
            f"horizontal_to={azimuth_to}", f"vertical_from={elevation_from}", f"vertical_to={elevation_to}"]


def obj(things):
    lines, count = ["mtllib scene.mtl"], 0
    for name, corners, faces in things:
        lines += [f"o {name}", "usemtl Plaster"] + ["v %.7f %.7f %.7f" % tuple(c) for c in corners]
        lines += ["f " + " ".join(str(count + k + 1) for k in face) for face in faces]
        count += len(corners)
    return "\n".join(lines) + "\n"


def quad(name, a, b, c, d):
    return name, (a, b, c, d), [(0, 1, 2, 3)]


def w_of(data, range_m):
    """Radius of the beam at 1/e² of an instrument's file."""
    beam = data["beam"]
    return math.hypot(beam["exit_diameter_mm"] * 1e-3, beam["divergence_mrad"] * 1e-3 * range_m) / 2


# ---------------------------------------------------------------------------------------------- 1 wires

def wire(name, azimuth, range_m, radius, half_height, sides=16):
    turn = 2 * np.pi * np.arange(sides) / sides
    x, y = range_m * math.cos(azimuth), range_m * math.sin(azimuth)
    corners = [(x + radius * math.cos(t), y + radius * math.sin(t), z) for z in (-half_height, half_height)
               for t in turn]
    return name, corners, [(i, (i + 1) % sides, sides + (i + 1) % sides, sides + i) for i in range(sides)]


def wires(bench):
    print("\nWires: 40 of 4 mm at random azimuths; how many have no point")
    dice = np.random.default_rng(2)
    for range_m, resolution in ((10, "6mm"), (10, "12mm"), (12, "6mm"), (12, "12mm")):
        azimuths = np.radians(90 + np.linspace(-14, 14, 40)) + 0.0012 * (dice.random(40) - 0.5)
        standing = [wire(f"wire{i}", a, range_m, 0.002, 0.3) for i, a in enumerate(azimuths)]
        wall = [quad("wall", (-9, range_m + 6, -2), (9, range_m + 6, -2), (9, range_m + 6, 2), (-9, range_m + 6, 2))]
        lost = {}
        for behind in ("nothing", "wall"):
            place = bench.project("wires", obj(standing + (wall if behind == "wall" else [])))
            bench.station(place, "--at", "0,0,0")
            settings = window(254, 286, -1, 1, resolution)

            def missed(points):
                turned = np.arctan2(points[:, 1], points[:, 0])
                near = np.abs(np.linalg.norm(points, axis=1) - range_m) < 0.5
                return sum(1 for a in azimuths if not np.any(near & (np.abs(turned - a) < 0.003)))

            for quality in ("default", "preview"):
                points, _ = bench.scan(place, "leica-rtc360", *settings, "--quality", quality)
                lost[f"ours {quality}", behind] = missed(places(points))
            if behind == "nothing":
                back = bench.project("backdrop", obj(wall))
                bench.station(back, "--at", "0,0,0")
                points, _ = bench.scan(back, "leica-rtc360", *settings, "--ideal")
                grid, misfit = grid_of(points, np.zeros(3))
                print(f"  at {range_m} m, {resolution} at 10 m: {grid[2]} columns, {len(grid[3])} rows "
                      f"(misfit {misfit:.1e} rad)")
            for divergence in (0.0005, 2 * 0.003905 / 10):
                for quality in (1, 3, 5):
                    points = bench.helios_grid(place, (0.0, 0.0, 0.0), grid, divergence, quality)
                    lost[f"HELIOS++ {divergence * 1e3:.2f} mrad, quality {quality}", behind] = missed(points[:, :3])
        for name in dict.fromkeys(k[0] for k in lost):
            print(f"    {name:34} nothing behind: {lost[name, 'nothing']:2} of 40, a wall 6 m behind: "
                  f"{lost[name, 'wall']:2}")


# ---------------------------------------------------------------------------------------------- 2 edges

LEAN = 0.06      # of the edge: each row crosses it at another offset


def edge_offsets(rays, range_m):
    """Distance of each axis from the leaning edge x = LEAN z in the plane y = range_m, positive beside the plate."""
    x, z = rays[:, 0] / rays[:, 1] * range_m, rays[:, 2] / rays[:, 1] * range_m
    return (x - LEAN * z) / math.hypot(1, LEAN)


def edges(bench):
    from scipy.special import erfc
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    print("\nEdges: a plate at 10 m before a wall, 20 offsets of the beam; power on the plate against ½ erfc(√2 x/w)")
    with open(os.path.join(INSTRUMENTS, "leica-rtc360.json")) as file:
        w = w_of(json.load(file), 10)
    offsets = np.linspace(-1.425, 1.425, 20)
    expected = 0.5 * erfc(math.sqrt(2) * offsets)
    figure, axes = plt.subplots(1, 3, figsize=(15, 4.2))
    axes[0].plot(offsets, expected, "k-", lw=1, label="½ erfc(√2 x/w)")
    for step_m in (1.0, 0.3, 0.1):
        y = 10 + step_m
        plate = quad("plate", (-2, 10, -1), (-LEAN, 10, -1), (LEAN, 10, 1), (-2, 10, 1))
        wall = quad("wall", (-2, y, -2), (2, y, -2), (2, y, 2), (-2, y, 2))
        place = bench.project("edges", obj([plate, wall]))
        bench.station(place, "--at", "0,0,0")

        def two_returns(data):
            data["waveform"]["most_returns"] = {"value": 4, "source": "unsourced"}
            data["settings"][0]["choices"] = [{"value": "6mm", "label": "fine", "columns": 120000, "rows": 45000,
                                               "scan_seconds": 51}]
        instrument = bench.instrument(place, "leica-rtc360", "two-returns", two_returns)
        settings = window(269.9, 270.1, -5, 5)
        found = {}
        ideal, _ = bench.scan(place, instrument, *settings, "--ideal")
        grid, _ = grid_of(ideal, np.zeros(3))
        first, turn, columns, elevations = grid
        axis = np.stack([np.cos(first + turn * np.arange(columns)), np.sin(first + turn * np.arange(columns))], 1)
        ours, _ = bench.scan(place, instrument, *settings, "--without", QUIET + ",detection,chance,filters")
        found["ours"] = (ours["Row"].astype(int), ours["Column"].astype(int), np.linalg.norm(places(ours), axis=1),
                         10 ** (ours["ReceivedPower"].astype(float) / 10))
        # The last: its disc of rays with the Gaussian's spread, radius w
        for name, divergence, quality in (("quality 3", 2 * w / 10, 3), ("quality 9", 2 * w / 10, 9),
                                          ("quality 9, 0.56 of it", w / 10 * 9 / 8, 9)):
            points = bench.helios_grid(place, (0.0, 0.0, 0.0), grid, divergence, quality)
            row, column = row_and_column(points[:, :3], grid)
            found["HELIOS++ " + name] = (np.rint(row).astype(int), np.rint(column).astype(int),
                                         np.linalg.norm(points[:, :3], axis=1), points[:, 3])
        rows, cols = np.meshgrid(np.arange(len(elevations)), np.arange(columns), indexing="ij")
        rays = np.stack([axis[cols, 0] * np.cos(elevations)[rows], axis[cols, 1] * np.cos(elevations)[rows],
                         np.sin(elevations)[rows]], 2).reshape(-1, 3)
        offset = edge_offsets(rays, 10) / w
        bins = np.rint((offset - offsets[0]) / (offsets[1] - offsets[0])).astype(int)
        bins[(offset < offsets[0] - 0.075) | (offset > offsets[-1] + 0.075)] = -1
        cosine = rays[:, 1]
        print(f"  step {step_m} m, w {w * 1e3:.2f} mm, {np.count_nonzero(bins >= 0)} pulses at the edge")
        for name, (row, column, range_m, power) in found.items():
            inside = (row >= 0) & (row < len(elevations)) & (column >= 0) & (column < columns)
            cell = row[inside] * columns + column[inside]
            depth = (range_m[inside] * cosine[cell] - 10) / step_m      # 0 on the plate, 1 on the wall
            # HELIOS++'s power falls with R⁻⁴ (see power): made up for, so that the beam alone is compared
            white = power[inside] * range_m[inside] ** (2 if name == "ours" else 4)
            front = np.bincount(cell, white * np.clip(1 - depth, 0, 1), len(offset))
            whole = np.bincount(cell, white, len(offset))
            share = np.full(len(offset), np.nan)
            share[whole > 0] = front[whole > 0] / whole[whole > 0]
            means = np.array([np.nanmean(share[bins == b]) for b in range(len(offsets))])
            stray = np.array([np.nanstd(share[bins == b]) for b in range(len(offsets))])
            at_edge = bins[cell] >= 0
            mixed = at_edge & (depth > 0.02) & (depth < 0.98)
            outside = at_edge & ((depth < -0.02) | (depth > 1.02))
            thirds = np.histogram(depth[mixed], (0.02, 1 / 3, 2 / 3, 0.98))[0]
            pulses = max(1, np.count_nonzero((bins >= 0) & (whole > 0)))
            two = np.count_nonzero(np.bincount(cell[at_edge], minlength=len(offset)) > 1)
            print(f"    {name:30} share - integral: rms {np.sqrt(np.mean((means - expected) ** 2)):.4f}, worst "
                  f"{np.abs(means - expected).max():.3f}; single pulse ±{np.mean(stray):.3f}; pulses with two echoes "
                  f"{100 * two / pulses:.0f} %; points between {100 * mixed.sum() / pulses:.0f} % of pulses, "
                  f"near/middle/far {'/'.join(map(str, thirds))}; outside both {np.count_nonzero(outside)}")
            if step_m == 1.0:
                axes[0].plot(offsets, means, "o" if name == "ours" else "x", ms=4, label=name)
            elif name in ("ours", "HELIOS++ quality 3"):
                axis_of = axes[1] if step_m == 0.3 else axes[2]
                axis_of.hist(depth[at_edge], np.linspace(-0.1, 1.1, 61), histtype="step", label=name)
    axes[0].set(xlabel="beam's axis beside the edge, x/w", ylabel="share of the power on the plate")
    axes[1].set(xlabel="depth: 0 plate, 1 wall", title="0.3 m", yscale="log", ylabel="points")
    axes[2].set(xlabel="depth: 0 plate, 1 wall", title="0.1 m", yscale="log", ylabel="points")
    for axis_of in axes:
        axis_of.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(os.path.join(bench.folder, "edges.png"), dpi=75)


# ---------------------------------------------------------------------------------------------- 3 rays

def rays(bench):
    print("\nRays: the house from one station, 1440 columns × 600 rows, no noise, one ray a pulse in both")
    place = bench.project("rays", bench.house)
    bench.run(bench.standpoint, "station", "p", "--add", "S1", "--on", "2,3", folder=place)

    def coarse(data):
        data["settings"][0]["choices"] = [{"value": "6mm", "label": "coarse", "columns": 1440, "rows": 600,
                                           "scan_seconds": 51}]
    instrument = bench.instrument(place, "leica-rtc360", "coarse", coarse)
    ours, pose = bench.scan(place, instrument, "--ideal")
    at = pose[:3]
    grid, misfit = grid_of(ours, at)
    theirs = bench.helios_grid(place, at.tolist(), grid, 0.0005, 1, min_m=0.3)
    row, column = row_and_column(theirs[:, :3] - at, grid)
    steep = np.abs(grid[3])[np.clip(np.rint(row).astype(int), 0, len(grid[3]) - 1)] > np.radians(80)
    columns = grid[2]
    r, c = np.rint(row).astype(int), np.rint(theirs[:, 6]).astype(int) - 1
    ranges = np.full((2, len(grid[3]) * columns), np.nan)
    ranges[0, ours["Row"].astype(int) * columns + ours["Column"].astype(int)] = np.linalg.norm(places(ours) - at,
                                                                                              axis=1)
    inside = (r >= 0) & (r < len(grid[3])) & (c >= 0) & (c < columns)
    ranges[1, r[inside] * columns + c[inside]] = np.linalg.norm(theirs[inside, :3] - at, axis=1)
    off = np.abs(column - c)[~steep]
    print(f"  their columns by azimuth and by pulse differ by {np.minimum(off, columns - off).max():.3f} at most, rows "
          f"by {np.abs(row - r)[~steep].max():.3f} of a step; grid misfit {misfit:.1e} rad")
    both = ~np.isnan(ranges).any(0)
    difference = np.abs(ranges[0] - ranges[1])[both]
    same = difference < 0.005
    met = ~np.isnan(ranges)
    print(f"  {ranges.shape[1]} rays; both met {both.sum()}, ours alone {np.sum(met[0] & ~met[1])}, HELIOS++ alone "
          f"{np.sum(met[1] & ~met[0])}")
    print(f"  |difference|: median {np.median(difference) * 1e3:.3f} mm, 99 % "
          f"{np.percentile(difference, 99) * 1e3:.3f} mm; another surface (over 5 mm): {np.sum(~same)}, the largest of "
          f"the others {difference[same].max() * 1e3:.3f} mm")


# ---------------------------------------------------------------------------------------------- 4 walk

FIRINGS_HZ = 2000     # of a head of VLP-16 at 10 turns a second, thinned: HELIOS++ takes whole hertz alone
WAY = ["2,3", "4.5,3", "4.5,2.2:2", "2,2.2", "2,3"]


def distance_to_triangles(points, triangles):
    """Of each point to the nearest of the triangles [n, 3, 3], by brute force."""
    a, ab, ac = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    normal = np.cross(ab, ac)
    size = np.linalg.norm(normal, axis=1)
    good = size > 1e-12
    a, ab, ac, normal = a[good], ab[good], ac[good], normal[good] / size[good][:, None]
    dots = (ab * ab).sum(1), (ab * ac).sum(1), (ac * ac).sum(1)
    whole = dots[0] * dots[2] - dots[1] ** 2
    found = []
    for p in points:
        ap = p - a
        d1, d2 = (ap * ab).sum(1), (ap * ac).sum(1)
        u, v = (dots[2] * d1 - dots[1] * d2) / whole, (dots[0] * d2 - dots[1] * d1) / whole
        inside = (u >= 0) & (v >= 0) & (u + v <= 1)
        best = np.where(inside, np.abs((ap * normal).sum(1)), np.inf).min()
        for start, side in ((a, ab), (a, ac), (a + ab, ac - ab)):
            t = np.clip(((p - start) * side).sum(1) / (side * side).sum(1), 0, 1)
            best = min(best, np.linalg.norm(p - start - t[:, None] * side, axis=1).min())
        found.append(best)
    return np.array(found)


def read_obj(file):
    corners, faces = [], []
    for line in open(file):
        if line.startswith("v "):
            corners.append([float(x) for x in line.split()[1:4]])
        elif line.startswith("f "):
            faces.append([int(x.split("/")[0]) - 1 for x in line.split()[1:4]])
    return np.array(corners)[np.array(faces)]


def vlp16(bench, place, name, heights=False, delay_us=0.001):
    """A VLP-16 of our file with other firings. Without delays its channels are a nanosecond apart, to be told apart."""
    def change(data):
        moving = data["moving"]
        moving["firing_us"] = {"value": 1e6 / FIRINGS_HZ, "source": "derived"}
        moving["channel_us"] = {"value": delay_us, "source": "derived"}
        figures.extend((moving["channel_elevations_deg"]["value"], moving["channel_heights_mm"]["value"]))
        if not heights:
            moving.pop("channel_heights_mm")
        data["range"]["min_m"] = {"value": 0.3, "source": "derived"}
    figures = []
    return bench.instrument(place, "velodyne-vlp-16", name, change), figures[0], figures[1], delay_us


def carried(bench, place, head):
    """Our points along the way, as a table by firing and channel."""
    points, _ = bench.scan(place, head[0], "--trajectory", "walk", "--trajectory-error", "none", "--ideal")
    firing = np.floor(points["Time"] * FIRINGS_HZ + 1e-5).astype(int)
    channel = np.rint((points["Time"] - firing / FIRINGS_HZ) * 1e6 / head[3]).astype(int)
    table = np.full((firing.max() + 1, 16, 3), np.nan)
    table[firing, channel] = places(points, true=True)
    return table


def helios_walk(bench, place, rate, elevations, heights=(0,) * 16, mount=(0, 0, 0), wrapped=False, pulses=False):
    """HELIOS++ along the way: its points as such a table, the way's samples, the folder of what it wrote."""
    home = os.path.join(place, "helios")
    bench.run(bench.standpoint, "trajectory", "p", "--write", "walk", "-o", "helios/walk.trj", "--rate", str(rate),
              folder=place)
    track = np.loadtxt(os.path.join(home, "walk.trj"), delimiter=",", comments="#")
    if wrapped:
        track[:, 1:4] -= 360 * np.round(track[:, 1:4] / 360)
        with open(os.path.join(home, "walk.trj"), "w") as file:
            file.write('#TIME_COLUMN: 0\n#HEADER: "t", "roll", "pitch", "yaw", "x", "y", "z"\n')
            np.savetxt(file, track, fmt="%.15g", delimiter=",")
    channels = "".join(channel(i, e, h * 1e-3) for i, (e, h) in enumerate(zip(elevations, heights)))
    write_scanner(place, "vlp16", channels, 0.002, 1, 6.0, 0, 0.25, 903, 0.1)
    turn = -3600 / FIRINGS_HZ
    survey = (f'<?xml version="1.0"?>\n<document>\n<scannerSettings id="s" active="true" pulseFreq_hz="{FIRINGS_HZ}" '
              f'scanAngle_deg="1" scanFreq_hz="0" headRotatePerSec_deg="{turn * FIRINGS_HZ!r}" '
              f'headRotateStart_deg="{-turn!r}" headRotateStop_deg="-360" trajectoryTimeInterval_s="0"/>\n'
              f'<survey name="walk" scene="scene.xml#scene" platform="interpolated" basePlatform="platforms.xml#post" '
              f'rotationSpec="CANONICAL" scanner="scanner.xml#vlp16">\n'
              f'<scannerMount x="{mount[0]}" y="{mount[1]}" z="{mount[2]}"/>\n<leg>'
              f'<platformSettings trajectory="walk.trj" tIndex="0" rollIndex="1" pitchIndex="2" yawIndex="3" '
              f'xIndex="4" yIndex="5" zIndex="6" slopeFilterThreshold="0.0" toRadians="true" syncGPSTime="true"/>'
              f'<scannerSettings template="s"/></leg>\n</survey>\n</document>\n')
    points = bench.helios_run(place, survey, "--splitByChannel", *(["--writePulse"] if pulses else []))
    table = np.full((int(points[:, 6].max()), 16, 3), np.nan)
    table[points[:, 6].astype(int) - 1, points[:, 8].astype(int)] = points[:, :3]
    return table, track


def tell(name, apart):
    print(f"    {name:62} median {np.median(apart) * 1e3:8.3f} mm, 95 % {np.percentile(apart, 95) * 1e3:8.3f}, 99 % "
          f"{np.percentile(apart, 99) * 1e3:8.2f}, over 10 mm {100 * np.mean(apart > 0.01):6.2f} %")


def apart(one, other):
    n = min(len(one), len(other))
    distance = np.linalg.norm(one[:n] - other[:n], axis=2)
    return distance[~np.isnan(distance)]


def walk(bench):
    print(f"\nWalk: a head of VLP-16 at 10 Hz, {FIRINGS_HZ} firings a second, along a way in the house; no errors")
    place = bench.project("walk", bench.house)
    bench.run(bench.standpoint, "trajectory", "p", "--add", "walk", "--through", *WAY, folder=place)
    plain = vlp16(bench, place, "plain")
    elevations, heights = plain[1], plain[2]
    ours = carried(bench, place, plain)
    triangles = read_obj(os.path.join(place, "helios", "scene.obj"))
    dice = np.random.default_rng(1)

    def surfaces(name, table):
        met = table[~np.isnan(table[..., 0])]
        some = met[dice.permutation(len(met))[:1500]]
        tell(name + " to the model's nearest surface", distance_to_triangles(some, triangles))
    theirs = {}
    for rate in (1000, 200, 100, 20, 10):
        theirs[rate], track = helios_walk(bench, place, rate, elevations)
        if rate == 1000:
            fine = track
            n = min(len(ours), len(theirs[rate]))
            a, b = ~np.isnan(ours[:n, :, 0]), ~np.isnan(theirs[rate][:n, :, 0])
            print(f"    {fine[-1, 0]:.1f} s, firings {len(ours)} and {len(theirs[rate])}; of {n * 16} pulses both met "
                  f"{np.sum(a & b)}, ours alone {np.sum(a & ~b)}, HELIOS++ alone {np.sum(~a & b)}; another surface "
                  f"(over 50 mm) {np.sum(apart(ours, theirs[rate]) > 0.05)}")
            surfaces("ours", ours)
            surfaces("HELIOS++", theirs[rate])
        tell(f"same pulse, HELIOS++ with {rate} samples a second", apart(ours, theirs[rate]))
    wrapped, _ = helios_walk(bench, place, 200, elevations, wrapped=True)
    tell("same pulse, 200 a second, angles that jump at 180°", apart(ours, wrapped))
    n = min(len(ours), len(wrapped))
    lost = np.any(np.linalg.norm(ours[:n] - wrapped[:n], axis=2) > 0.5, axis=1)
    lost &= ~np.any(np.linalg.norm(ours[:n] - theirs[200][:n], axis=2) > 0.5, axis=1)
    print(f"      firings more than 0.5 m off that are not without the jump: {np.sum(lost)}")
    own = carried(bench, place, vlp16(bench, place, "heights", heights=True))
    tell("same pulse, with the heights of the beams' origins in both",
         apart(own, helios_walk(bench, place, 1000, elevations, heights)[0]))
    tell("same pulse, ours with channels 2.304 µs apart",
         apart(carried(bench, place, vlp16(bench, place, "delays", delay_us=2.304)), theirs[1000]))
    # A scanner that is mounted aside: where their pulses begin, against the arm turned with the body.
    arm = np.array([0.1, 0.2, 0.5])
    helios_walk(bench, place, 1000, elevations, mount=arm, pulses=True)
    names = sorted(glob.glob(os.path.join(place, "helios", "out", "**", "*pulse*"), recursive=True))
    origins = np.vstack([np.loadtxt(f, ndmin=2) for f in names if os.path.getsize(f)])
    origins = origins[origins[:, 8] == 0] if origins.shape[1] > 8 else origins
    times = (origins[:, 7] - 1) / FIRINGS_HZ
    at = np.stack([np.interp(times, fine[:, 0], fine[:, k]) for k in (4, 5, 6)], 1)
    angles = np.stack([np.interp(times, fine[:, 0], fine[:, k]) for k in (1, 2, 3)], 1)
    turned = rotations(angles) @ arm
    tell("their pulses' origin, mount at (0.1, 0.2, 0.5) m: to the turned arm",
         np.linalg.norm(origins[:, :3] - at - turned, axis=1))
    tell("… to the arm in world axes", np.linalg.norm(origins[:, :3] - at - arm, axis=1))


def rotations(angles_deg):
    """Rx(roll) Ry(pitch) Rz(yaw), HELIOS++'s canonical angles."""
    a, b, c = np.radians(angles_deg).T
    zero, one = np.zeros_like(a), np.ones_like(a)

    def matrix(*rows):
        return np.stack([np.stack(row, -1) for row in rows], -2)
    x = matrix((one, zero, zero), (zero, np.cos(a), -np.sin(a)), (zero, np.sin(a), np.cos(a)))
    y = matrix((np.cos(b), zero, np.sin(b)), (zero, one, zero), (-np.sin(b), zero, np.cos(b)))
    z = matrix((np.cos(c), -np.sin(c), zero), (np.sin(c), np.cos(c), zero), (zero, zero, one))
    return x @ y @ z


# ---------------------------------------------------------------------------------------------- 5 power

def power(bench):
    print("\nPower: plates head-on at 2 to 100 m, and at 10 m turned by 0 to 85°, relative to the one at 10 m head-on")
    things, looks = [], []
    for k, (range_m, turn_deg) in enumerate([(r, 0) for r in (2, 3, 5, 10, 20, 50, 100)] +
                                            [(10, t) for t in (15, 30, 45, 60, 70, 75, 80, 85)]):
        azimuth = math.radians(24 * k + 0.01)
        ahead = np.array([math.cos(azimuth), math.sin(azimuth), 0])
        side = np.array([-math.sin(azimuth), math.cos(azimuth), 0])
        turned = math.cos(math.radians(turn_deg)) * side + math.sin(math.radians(turn_deg)) * ahead
        half, up = 0.04 * range_m, np.array([0, 0, 0.05 * range_m])
        middle = ahead * range_m
        things.append(quad(f"plate{k}", middle - half * turned - up, middle + half * turned - up,
                           middle + half * turned + up, middle - half * turned + up))
        looks.append((azimuth, range_m, turn_deg))
    place = bench.project("power", obj(things))
    bench.station(place, "--at", "0,0,0")

    def fine(data):
        data["settings"][0]["choices"] = [{"value": "6mm", "label": "fine", "columns": 14400, "rows": 600,
                                           "scan_seconds": 51}]
    instrument = bench.instrument(place, "leica-rtc360", "fine", fine)
    ball = bench.project("ball", obj([quad("wall", (-50, 50, -40), (50, 50, -40), (50, 50, 80), (-50, 50, 80))]))
    bench.station(ball, "--at", "0,0,0")
    shutil.copy(os.path.join(place, instrument), ball)
    ideal, _ = bench.scan(ball, instrument, *window(0, 360, -0.5, 0.5), "--ideal")
    grid, _ = grid_of(ideal, np.zeros(3))
    grid = (grid[0], grid[1], 14400, grid[3])
    ours, _ = bench.scan(place, instrument, *window(0, 360, -0.5, 0.5), "--without",
                         QUIET.replace(",near-range", "").replace(",atmosphere", "") + ",detection,chance,filters")
    tables = {"ours": (places(ours), 10 ** (ours["ReceivedPower"].astype(float) / 10))}
    for quality in (1, 3):
        points = bench.helios_grid(place, (0.0, 0.0, 0.0), grid, 0.0005, quality, min_m=0.5)
        tables[f"HELIOS++ quality {quality}"] = points[:, :3], points[:, 3]
    print("    range, turn: Lambert's cos θ / R², Oren and Nayar's for plaster; " + "  ".join(tables)
          + " (over Lambert)")
    rows = []
    for azimuth, range_m, turn_deg in looks:
        row = []
        for where, much in tables.values():
            off = np.angle(np.exp(1j * (np.arctan2(where[:, 1], where[:, 0]) - azimuth)))
            chosen = (np.abs(off) < 0.0015) & (np.abs(where[:, 2]) < 0.006 * range_m)
            row.append(np.median(much[chosen]) if chosen.any() else np.nan)
        rows.append(row)
    rows = np.array(rows)
    rows /= rows[3]
    variance = 0.35 ** 2       # of plaster_render
    A, B = 1 - 0.5 * variance / (variance + 0.33), 0.45 * variance / (variance + 0.09)
    for (azimuth, range_m, turn_deg), row in zip(looks, rows):
        law = math.cos(math.radians(turn_deg)) * 100 / range_m ** 2
        rough = 1 + B / A * math.sin(math.radians(turn_deg)) * math.tan(math.radians(turn_deg))
        print(f"    {range_m:3} m, {turn_deg:2}°: {law:9.5f}, {law * rough:9.5f}; "
              + "  ".join(f"{x:9.5f} ({10 * math.log10(x / law):+6.2f} dB)" for x in row))


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    standpoint, helios = os.path.realpath(sys.argv[1]), os.path.realpath(sys.argv[2])
    if not os.access(helios, os.X_OK):
        print(f"skipped: HELIOS++ is not there ({helios}); build helios++ and give its path")
        return
    folder = os.path.realpath(sys.argv[3])
    os.makedirs(folder, exist_ok=True)
    house = os.path.realpath(sys.argv[4] if len(sys.argv) > 4
                             else os.path.join(os.path.dirname(standpoint), "..", "samples", "house.ifc"))
    bench = Bench(standpoint, helios, folder, house)
    for part in sys.argv[5:] or ("wires", "edges", "rays", "walk", "power"):
        {"wires": wires, "edges": edges, "rays": rays, "walk": walk, "power": power}[part](bench)


if __name__ == "__main__":
    main()
