#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What `standpoint plan` forecasts beside what a scan from the same stations measures.

The scan's area is counted without the plan's own means: every point stands for r^2 dAz dEl cos(el) / cos(incidence) of
the surface that it lies on, by the true range and incidence that --truth writes. It wants a project with stations:
    bench/plan_beside_scan.py build/release/bin/standpoint PROJECT
"""
import json, math, pathlib, struct, subprocess, sys, tempfile

ARGUMENTS = ["--instrument", "faro-focus-s350", "--set", "resolution=1/20", "quality=4x"]
FIELD_rad2 = 2 * math.pi * math.radians(150)   # of a FARO's whole field, in azimuth times elevation
NO_SURFACE_OF_ITS_OWN = 2 | 8 | 64             # mirrored, weather, noise
SIZES = {"double": "d", "float": "f", "int": "i", "uchar": "B"}


def run(standpoint, *arguments):
    done = subprocess.run([standpoint, *map(str, arguments), "--json"], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr or done.stdout)
    return json.loads(done.stdout)


def measured(ply, pulses, origin):
    data = ply.read_bytes()
    head = data[:data.index(b"end_header\n")].decode("latin1").splitlines()
    fields = [line.split()[1:] for line in head if line.startswith("property ")]
    record = struct.Struct("<" + "".join(SIZES[kind] for kind, _ in fields))
    at = {name: index for index, (_, name) in enumerate(fields)}
    names = ("x", "y", "z", "scalar_TrueRange", "scalar_Incidence", "scalar_Flags")
    x, y, z, true_range, incidence, flags = (at[name] for name in names)
    area, points = 0.0, 0
    for p in record.iter_unpack(data[data.index(b"end_header\n") + 11:]):
        points += 1
        if p[flags] & NO_SURFACE_OF_ITS_OWN:
            continue
        across = math.hypot(p[x] - origin[0], p[y] - origin[1])
        cosine_of_elevation = across / max(1e-9, math.hypot(across, p[z] - origin[2]))
        area += p[true_range] ** 2 * cosine_of_elevation / max(0.005, math.cos(p[incidence]))
    return area * FIELD_rad2 / pulses, points


standpoint, project = sys.argv[1:3]
for station in run(standpoint, "station", project)["stations"]:
    name = station["name"]
    forecast = run(standpoint, "plan", project, "--stations", name, *ARGUMENTS)["stations"][0]
    with tempfile.TemporaryDirectory() as folder:
        e57, ply = pathlib.Path(folder, "s.e57"), pathlib.Path(folder, "s.ply")
        scan = run(standpoint, "scan", project, "--stations", name, *ARGUMENTS, "--truth", "-o", e57)["stations"][0]
        run(standpoint, "convert", e57, ply)
        area, points = measured(ply, scan["pulses"], station["at"])
    print(f"{name:8} seen {forecast['seen_m2']:8.1f} m2, measured {area:8.1f} m2: {100 * (forecast['seen_m2'] / area - 1):+5.1f} %;  "
          f"points {forecast['points']:9}, scanned {points:9}: {100 * (forecast['points'] / points - 1):+5.1f} %")
