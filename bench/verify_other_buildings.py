#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges `standpoint verify` on buildings: each is scanned as it is assigned, and with one material swapped for another when it
is scanned, and verified as it was assigned. Which products are swapped and for what is drawn by a seed, not chosen.

usage: verify_other_buildings.py SEED MODEL.ifc …   (STANDPOINT: the command, default `standpoint`)
"""
import json, math, os, random, shutil, subprocess, sys, tempfile

STANDPOINT = os.environ.get("STANDPOINT", "standpoint")
INSTRUMENTS = [("leica-rtc360", "resolution=12mm"), ("faro-focus-s350", "resolution=1/16"), ("trimble-x7", "duration=2min")]
LIBRARY = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "materials", "library")
FINDABLE_DB = 2.0            # what verify says it finds is above 1 dB and the spread; below this nothing is swapped here


def run(*words):
    done = subprocess.run([STANDPOINT, *map(str, words), "--json", "--allow-loss"], capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"{words[0]}: {done.stderr.strip()[-300:]}")
    return json.loads(done.stdout)


def reflectances(nm):
    """Of the library's opaque materials at a wavelength; where two figures enclose it."""
    found = {}
    for name in sorted(os.listdir(LIBRARY)):
        for m in json.load(open(os.path.join(LIBRARY, name))).get("materials", []):
            rows = m.get("reflectance")
            if not isinstance(rows, list) or "transmittance" in m:
                continue
            for (a, x), (b, y) in zip(rows, rows[1:]):
                if a <= nm <= b:
                    found[m["id"]] = x + (y - x) * (nm - a) / (b - a)
    return {k: v for k, v in found.items() if v > 0.01}


def placed(project):
    """Two stations where most is seen, one before the building."""
    run("station", project, "--add", "S1")
    run("station", project, "--add", "S2")
    low, high = run("info", project)["bounds"]
    run("station", project, "--add", "S3", "--stand", "free", "--at", f"{low[0] - 3},{(low[1] + high[1]) / 2},{max(low[2], 0) + 1.7}")


def verified(project, scanned, instrument, setting, folder):
    cloud = f"{folder}/scan.e57"
    run("scan", scanned, "--instrument", instrument, "--set", setting, "-o", cloud)
    held = f"{folder}/held"
    shutil.rmtree(held, ignore_errors=True)
    shutil.copytree(project, held)
    run("underlay", held, "--add", cloud, "--name", "scan", "--at", "0,0,0")
    return run("verify", held, "scan", "--instrument", instrument)


def drawn(answer, known, dice):
    """Products of one material that the first scan could judge and that is not most of what it saw, and what they shall be."""
    rows = [m for m in answer["materials"] if m["judged"] and m["material"] in known and m["points"] < 0.4 * answer["compared"]]
    if not rows:
        return None
    row = dice.choice(rows)
    here = known[row["material"]]
    others = [k for k, v in sorted(known.items()) if abs(10 * math.log10(v / here)) >= FINDABLE_DB]
    return row["material"], row["products"], dice.choice(others)


def judged(answer, products, instead):
    """right, otherwise named, elsewhere: proposals on the swapped products that name the material, that do not, and on others."""
    counts = [0, 0, 0]
    for p in answer["proposals"]:
        on = len(set(p["products"]) & set(products)) >= 0.5 * len(p["products"])
        counts[2 if not on else 0 if instead in [p["behaves_like"], *p["alike"]] else 1] += 1
    return counts


def told(answer):
    text = "; ".join(f"{p['material']} → {p['behaves_like']} ({len(p['products'])}, {p['off_db']:+.1f} dB)" for p in answer["proposals"])
    return text or answer["no_verdict"] or "nothing"


def main():
    dice = random.Random(int(sys.argv[1]))
    for model in sys.argv[2:]:
        with tempfile.TemporaryDirectory() as folder:
            project, other = f"{folder}/as", f"{folder}/other"
            run("import", model, "-o", project)
            run("materials", project)
            placed(project)
            for instrument, setting in INSTRUMENTS:
                name = f"{os.path.basename(model)} {instrument}"
                try:
                    answer = verified(project, project, instrument, setting, folder)
                    print(f"{name}: nothing swapped: {len(answer['proposals'])} proposals ({told(answer)}), {answer['compared']} points", flush=True)
                    known = reflectances(answer["wavelength_nm"])
                    swap = drawn(answer, known, dice)
                    if swap is None:
                        print(f"{name}: nothing that could be swapped was judged", flush=True)
                        continue
                    was, products, instead = swap
                    shutil.rmtree(other, ignore_errors=True)
                    shutil.copytree(project, other)
                    run("materials", other, "--assign", *[f"{p}={instead}" for p in products])
                    answer = verified(project, other, instrument, setting, folder)
                    db = 10 * math.log10(known[instead] / known[was])
                    print(f"{name}: {len(products)} of {was} are {instead} ({db:+.1f} dB): right, otherwise, elsewhere "
                          f"{judged(answer, products, instead)}: {told(answer)}", flush=True)
                except RuntimeError as error:
                    print(f"{name}: {error}", flush=True)


main()
