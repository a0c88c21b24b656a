#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What ten thousand stations cost, by a slice of them: processor's seconds, memory, bytes. Needs Debian's python3-numpy.

usage: ten_thousand.py STANDPOINT OUTDIR MODEL ...

Each model gets three stations, where they add most to what is seen. Two instruments at two resolutions scan them to E57
with truth on one thread, the first station in a process of its own and all three in one. The seconds of all processes,
user and system, are fitted by s + p pulses + q points with an s for each model, so that relative errors are least. The
cloud next to 15 million points is converted to the other formats. Files are removed once they are measured.
"""
import os
import shutil
import sys

import numpy as np

from own_points import measured, run

SETTINGS = (("faro-focus-s350", "resolution=1/8", "quality=4x"), ("faro-focus-s350", "resolution=1/5", "quality=4x"),
            ("leica-rtc360", "resolution=12mm"), ("leica-rtc360", "resolution=6mm"))
STATIONS = ("S1", "S2", "S3")
CONVERTED = 15e6  # points
FORMATS = (("E57 of integers (`--as scaled`)", "scaled.e57", ("--as", "scaled")), ("LAS", "cloud.las", ()), ("PLY", "cloud.ply", ()),
           ("PCD", "cloud.pcd", ()), ("CSV", "cloud.csv", ()))
CAMPAIGN, TO_AN_ENVIRONMENT = 10_000, 200  # stations


class Slice:
    def __init__(self, standpoint):
        self.standpoint = standpoint
        self.rows = []  # of a process: model, pulses, points, seconds, memory
        self.scans = []  # of a station: pulses, points, bytes
        self.forecast = []  # of a setting and model: points by `plan`, and by the scans
        self.kept = None  # points of the cloud to convert, and its file

    def take(self, model, setting, stations):
        instrument, *words = setting
        answer, seconds, memory = measured(self.standpoint, "scan", "p", "--stations", stations, "--instrument", instrument, "--set", *words,
                                           "--truth", "--threads", "1", "-o", "scans")
        found = [(s["pulses"], s["points"], os.path.getsize(s["file"]), s["file"]) for s in answer["stations"]]
        pulses, points = (sum(s[k] for s in found) for k in (0, 1))
        self.rows.append((model, pulses, points, seconds, memory))
        print(f"  {instrument:16} {' '.join(words):30} {stations:4} {points / 1e6:6.1f} M points {seconds:7.1f} s {memory:5.0f} MB", flush=True)
        for _, count, _, file in found:
            if not self.kept or abs(count - CONVERTED) < abs(self.kept[0] - CONVERTED):
                shutil.move(file, "kept.e57")
                self.kept = (count, "kept.e57")
        shutil.rmtree("scans")
        return found

    def model(self, number, model):
        shutil.rmtree("p", ignore_errors=True)
        imported, _, _ = measured(self.standpoint, "import", model, "-o", "p", "--allow-loss")
        run(self.standpoint, "materials", "p")
        for name in STATIONS:
            run(self.standpoint, "station", "p", "--add", name)
        print(f"{os.path.basename(model)}: {imported['triangles']} triangles")
        for setting in SETTINGS:
            self.take(number, setting, STATIONS[0])
            scans = self.take(number, setting, "all")
            self.scans += [s[:3] for s in scans]
            plan, _, _ = measured(self.standpoint, "plan", "p", "--instrument", setting[0], "--set", *setting[1:])
            self.forecast.append((plan["points"], sum(s[1] for s in scans)))


def fitted(rows, models):
    """Seconds of a process for each model, of a pulse and of a point, and the worst relative error."""
    a = np.array([[model == number for number in range(models)] + [pulses, points] for model, pulses, points, _, _ in rows], float)
    seconds = np.array([row[3] for row in rows])
    best = np.linalg.lstsq(a / seconds[:, None], np.ones(len(rows)), rcond=None)[0]
    return best[:models], best[-2], best[-1], np.abs(a @ best / seconds - 1).max()


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    standpoint, folder, models = os.path.abspath(sys.argv[1]), sys.argv[2], [os.path.abspath(m) for m in sys.argv[3:]]
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    os.chdir(folder)
    cost = Slice(standpoint)
    for number, model in enumerate(models):
        cost.model(number, model)
    starts, pulse, point, worst = fitted(cost.rows, len(models))
    pulses, points, size = np.array(cost.scans, float).T
    memory = [row[4] for row in cost.rows]
    print(f"\na million pulses {pulse * 1e6:.3f} s, a million points {point * 1e6:.3f} s; a process "
          + ", ".join(f"{s:.1f} s ({os.path.basename(m)})" for s, m in zip(starts, models)) + f"; off by {100 * worst:.0f} % at worst")
    print(f"memory {min(memory):.0f} to {max(memory):.0f} MB; scans of {points.min() / 1e6:.1f} to {points.max() / 1e6:.1f} M points")
    print(f"bytes of a point {size.sum() / points.sum():.1f} ({(size / points).min():.1f} to {(size / points).max():.1f})")
    print(f"plan's points, of the scans' {min(p / s for p, s in cost.forecast):.4f} to {max(p / s for p, s in cost.forecast):.4f}")
    whole = os.path.getsize(cost.kept[1])
    for name, file, options in FORMATS:
        _, seconds, _ = measured(standpoint, "convert", cost.kept[1], file, *options, "--allow-loss")
        print(f"{name:32} {os.path.getsize(file) / whole:.2f} of the E57's bytes, {seconds:.1f} s for {cost.kept[0] / 1e6:.1f} M points")
        os.remove(file)
    each = pulse * pulses.mean() + point * points.mean()
    print(f"{CAMPAIGN} stations of {points.mean() / 1e6:.1f} M points and {pulses.mean() / 1e6:.1f} M pulses: {CAMPAIGN * each / 3600:.1f} h of one "
          f"core, {CAMPAIGN * size.mean() / 1e12:.1f} TB; a process for each {CAMPAIGN * starts.mean() / 3600:.1f} h more, for each {TO_AN_ENVIRONMENT} "
          f"{CAMPAIGN / TO_AN_ENVIRONMENT * starts.mean() / 3600:.2f} h")


if __name__ == "__main__":
    main()
