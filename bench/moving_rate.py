#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pulses per CPU second along a trajectory, with and without what moves, beside a scan from a tripod in the same hall.

usage: moving_rate.py STANDPOINT OUTDIR HALL.obj [INSTRUMENT ...]   (leica-blk2go velodyne-vlp-16 without)

A hundred people walk about in the hall while a scanner is carried along a rectangle of 16 m by 8 m around the hall's
origin. What one of ten thousand shards takes (reading the project, building the ray scene and the trees) is subtracted
from the CPU seconds of each run. Everything is written to OUTDIR: a file system in memory is best.
Needs Debian's python3-numpy.
"""
import os
import sys

from own_points import measured, run

CORNERS = ("-8,-4", "8,-4", "8,4", "-8,4")


def rate(command, hardly_any, folder):
    """Millions of pulses, those per CPU second, MB."""
    _, idle, _ = measured(*command, *hardly_any, "-o", "o.e57", folder=folder)
    scans, cpu, memory = measured(*command, "-o", "o.e57", folder=folder)
    os.remove(os.path.join(folder, "o.e57"))
    pulses = (scans.get("stations") or scans.get("trajectories") or [scans])[0]["pulses"] / 1e6
    return pulses, pulses / (cpu - idle), memory


def main():
    standpoint, folder, hall = (os.path.abspath(path) for path in sys.argv[1:4])
    os.makedirs(folder, exist_ok=True)
    if not os.path.exists(os.path.join(folder, "p")):
        for command in (["import", hall, "-o", "p", "--up", "z", "--allow-loss"], ["collide", "p"],
                        ["station", "p", "--add", "S1", "--at", "0,0,1.7"],
                        ["trajectory", "p", "--add", "W", "--through=" + CORNERS[0], *CORNERS[1:]],
                        ["mover", "p", "--add", "crowd", "--kind", "crowd", "--count", "100"]):
            run(standpoint, *command, folder=folder)
    scan = [standpoint, "scan", "p", "--seed", "1"]
    print(f"{'':44}{'M pulses':>10}{'M per CPU s':>12}{'MB':>7}")

    def show(title, command, hardly_any):
        pulses, per_s, memory = rate(command, hardly_any, folder)
        print(f"{title:44}{pulses:10.1f}{per_s:12.2f}{memory:7.0f}", flush=True)

    from_tripod = [*scan, "--instrument", "leica-rtc360", "--set", "resolution=6mm", "--movers"]
    for movers in ("off", "on"):
        show(f"leica-rtc360, movers {movers}", [*from_tripod, movers], ["--field-fault", "until=0.0001"])
    for instrument in sys.argv[4:] or ("leica-blk2go", "velodyne-vlp-16"):
        for movers, operator in (("off", "off"), ("on", "off"), ("on", "on")):
            carried = [*scan, "--instrument", instrument, "--trajectory", "W", "--movers", movers, "--operator", operator]
            show(f"{instrument}, movers {movers}, operator {operator}", carried, ["--shard", "1/10000"])


main()
