#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Speed and memory of a scan to E57 beside bare Embree in the same minute.

    scan_beside_embree.py HALL.obj PIPELINE [--standpoint PATH] [--resolution 6mm] [--repeat 2]

PIPELINE is a program that traces HALL.obj itself and prints 'pipeline ... T1: ... Mpts/s wall, ... Mpts/cpu-s' for one and
two threads: rays in Embree's packets, noise, intensity, labels and 32 bytes of each point to a file of the working folder.
Both are given CPU seconds and wall seconds; where others use the machine only the former mean something. Of the scan, what
one of a few hundred pulses takes (reading the project and building the ray scene) is told by itself and subtracted.
Everything is written to TMPDIR: set it to a file system in memory. The station stands at (0, 0, 1.7)."""
import argparse
import json
import os
import re
import shutil
import subprocess
import tempfile
import time


def run(command, folder):
    """Standard output, CPU seconds, wall seconds and the peak of memory in MB."""
    begin = time.monotonic()
    process = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    output = process.stdout.read().decode()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        raise SystemExit(f"{' '.join(command)} failed")
    return output, usage.ru_utime + usage.ru_stime, time.monotonic() - begin, usage.ru_maxrss / 1024


def scan(arguments, folder, resolution, threads, *options):
    command = [arguments.standpoint, "scan", "p", "--instrument", "leica-rtc360", "--set", "resolution=" + resolution]
    command += [*options, "--threads", str(threads), "--seed", "1", "-o", "o.e57", "--json"]
    output, cpu, wall, memory = run(command, folder)
    os.remove(os.path.join(folder, "o.e57"))
    return json.loads(output)["stations"][0]["pulses"], cpu, wall, memory


def pipeline(arguments, folder):
    """Points per second by threads: of CPU time and of wall time."""
    output = run([arguments.pipeline, arguments.hall], folder)[0]
    found = re.findall(r"^pipeline.*T(\d): .*= ([0-9.]+) Mpts/s wall, ([0-9.]+) Mpts/cpu-s", output, re.M)
    return {int(threads): (float(cpu), float(wall)) for threads, wall, cpu in found}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("hall")
    parser.add_argument("pipeline")
    parser.add_argument("--standpoint", default="build/release/bin/standpoint")
    parser.add_argument("--resolution", default="6mm")
    parser.add_argument("--repeat", type=int, default=2)
    arguments = parser.parse_args()
    for name in ("hall", "pipeline", "standpoint"):
        setattr(arguments, name, os.path.abspath(getattr(arguments, name)))
    folder = tempfile.mkdtemp()
    try:
        run([arguments.standpoint, "import", arguments.hall, "-o", "p", "--up", "z", "--allow-loss"], folder)
        run([arguments.standpoint, "station", "p", "--add", "S1", "--at", "0,0,1.7"], folder)
        window = ["field_of_view=target_area"] + [f"{k}={v}" for k, v in
                  {"horizontal_from": 0, "horizontal_to": 2, "vertical_from": 0, "vertical_to": 2}.items()]
        ready = min((scan(arguments, folder, "12mm", 1, *window) for _ in range(arguments.repeat)), key=lambda r: r[1])
        print(f"ready to scan: {ready[1]:.2f} s CPU, {ready[2]:.2f} s wall, {ready[3]:.0f} MB at most")
        for name, options in (("default", []), ("without footprint", ["--without", "footprint"])):
            for threads in (1, 2):
                peer = pipeline(arguments, folder)
                runs = [scan(arguments, folder, arguments.resolution, threads, *options) for _ in range(arguments.repeat)]
                again = pipeline(arguments, folder)
                raw_cpu, raw_wall = (max(peer[threads][k], again[threads][k]) for k in (0, 1))
                pulses, memory = runs[0][0], max(r[3] for r in runs)
                cpu, wall = (pulses / (min(r[k] for r in runs) - ready[k]) / 1e6 for k in (1, 2))
                print(f"{name}, {threads} thread{'s' * (threads > 1)}: {pulses / 1e6:.1f} M pulses, "
                      f"{cpu:.2f} M per CPU second = {cpu / raw_cpu:.2f} of {raw_cpu:.2f}, "
                      f"{wall:.2f} M/s wall = {wall / raw_wall:.2f} of {raw_wall:.2f}, {memory:.0f} MB at most", flush=True)
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
