#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A segmentation that learns from simulated points alone, tested on buildings that it has not seen and on a real scan. Needs Debian's python3-sklearn,
python3-scipy and python3-matplotlib.

usage: segmentation.py STANDPOINT OUTDIR [CORPUS [SEEDS]]

For each seed (3) a recipe scans every building with all effects, without mixed points, without noise, without either, and ideally; gradient boosting learns
the classes of the training buildings by the shape of each point's surroundings, and labels the others; `standpoint score` counts. CORPUS is a folder with
ifc/ and pointcloud/. Without it (or with -) the samples beside the program are used, house.ifc to learn from and street.ifc to test on, and there is no real
scan. The real scan is also simulated: its own surfaces, scanned from the same place (twin). OUTDIR gets the figures (figures.json), their tables
(tables.md) and a picture (segmentation.png); thinned clouds (clouds-SEED.npz) that lie there already are used again.
"""
import json
import os
import shutil
import sys
import time

os.environ["OMP_NUM_THREADS"] = "1"  # before the libraries read it: with more, waiting threads slow down whatever else runs

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from scipy.spatial import cKDTree
from sklearn.ensemble import HistGradientBoostingClassifier
from sklearn.metrics import confusion_matrix, jaccard_score

from own_points import read_ply, run

TRAIN = {"duplex": "goedertier__Duplex_A_20110907_georeferenced.ifc", "fzk": "webifc__AC20-FZK-Haus.ifc", "niedriha": "bimserver__AC90R1-niedriha-V2-2x3.ifc"}
TEST = {"sample": "yousheng__Ifc4_SampleHouse.ifc", "xbim": "xbimess__House.ifc"}
REAL = "pointcloud/e57/pumpA_leica_tls_structured_image.e57"
NOISE = "range-noise,angle-noise,bias,striping,amplitude-noise,incidence-noise,range-offset,multipath,quantisation"
EFFECTS = {"all": {}, "no-mixed": {"without": "footprint"}, "no-noise": {"without": NOISE}, "neither": {"without": NOISE + ",footprint"},
           "ideal": {"ideal": True}}
WITHOUT_MIXED = ("no-mixed", "neither")  # panes mix, too, and stay: what is still flagged is dropped
STATIONS = 3
CELL_M = 0.05
BORDER = 0.31        # of a cell: planes at whole centimetres, as models have them, are not on the border of cells, where noise would double them
LEVELS = 4           # cells of 5, 10, 20 and 40 cm, surroundings of three cells
NEIGHBOURS = 32      # a disc of three cells has 28
REACH_M = 3.5        # up and down from a point to the lowest and highest of its column
PER_CLASS = 3000     # points to learn from, of each class in each building
TESTED = 40000       # points of a cloud that are labelled
MIXED = 1            # bit of a point's flags
HERE = os.path.dirname(os.path.realpath(__file__))
CLASSES = {
    "name": "Segmentation", "source": "bench/segmentation.py", "unknown": "object", "noise": "unlabelled", "ignore": ["unlabelled"],
    "classes": {"unlabelled": 0, "ceiling": 1, "floor": 2, "wall": 3, "beam": 4, "window": 5, "door": 6, "object": 7},
    "ifc": {"IfcWall": "wall", "IfcCurtainWall": "window", "IfcPlate": "window", "IfcSlab": ["floor", "ceiling"], "IfcRoof": "ceiling",
            "IfcCovering": ["floor", "ceiling"], "IfcBeam": "beam", "IfcMember": "beam", "IfcColumn": "beam", "IfcPile": "beam", "IfcWindow": "window",
            "IfcDoor": "door", "IfcRamp": "floor", "IfcPavement": "floor", "IfcSite": "floor", "IfcGeographicElement": "floor"},
}
NAMES = {number: name for name, number in CLASSES["classes"].items()}
COLOURS = np.array([[.8, .8, .8], [.62, .79, .88], [.65, .55, .40], [.93, .87, .70], [.55, .34, .65], [.20, .45, .80], [.85, .45, .15], [.30, .62, .30]])


def cells_of(xyz, size):
    cells = np.floor(xyz / size + BORDER).astype(np.int64)
    cells -= cells.min(axis=0)
    extent = cells.max(axis=0) + 1
    return (cells[:, 0] * extent[1] + cells[:, 1]) * extent[2] + cells[:, 2]


def thinned(xyz, size, order):
    """Indices of one point in each cell, the first by the order."""
    return order[np.unique(cells_of(xyz, size)[order], return_index=True)[1]]


def middles(xyz, size):
    """Mean of the points of each cell."""
    _, cell, count = np.unique(cells_of(xyz, size), return_inverse=True, return_counts=True)
    return np.stack([np.bincount(cell, xyz[:, k]) for k in range(3)], axis=1) / count[:, None]


def recipe(models, seed, splits):
    return {"format": "standpoint-dataset", "recipe_version": 1, "name": "segmentation", "license": "https://spdx.org/licenses/CC-BY-4.0.html",
            "creator": "bench/segmentation.py", "date": "2026-01-31", "seed": 1, "environments": [{"id": k, "model": v} for k, v in models.items()],
            "stations": [{"strategy": "greedy", "count": STATIONS}],
            "instruments": [{"id": "focus", "instrument": "faro-focus-s350", "set": ["resolution=1/32", "quality=4x", "colour=off"]}],
            "effects": [dict(id=k, **v) for k, v in EFFECTS.items()], "seeds": [seed], "splits": splits, "classes": ["segmentation.json"],
            "output": {"format": "ply", "truth": True}}


def cloud_of(folder, environment, effects, seed):
    """A building's scans with one set of effects, thinned together: places, scanners, labels, mixed."""
    parts = []
    for station in sorted(os.listdir(os.path.join(folder, "scans", environment))):
        name = f"focus_clear_assigned_none_{seed}_{effects}"
        points, pose = read_ply(os.path.join(folder, "scans", environment, station, name + ".ply"))
        labels = np.load(os.path.join(folder, "labels", environment, station, name + ".segmentation.npy"))
        xyz = np.stack([points[k] for k in "xyz"], axis=1).astype(float)
        parts.append((xyz, np.tile(pose[:3], (len(xyz), 1)), labels.astype(np.int64), (points["Flags"] & MIXED) > 0))
    xyz, at, labels, mixed = (np.concatenate(columns) for columns in zip(*parts))
    order = np.random.default_rng(seed).permutation(len(xyz))
    keep = thinned(xyz, CELL_M, order[~mixed[order]] if effects in WITHOUT_MIXED else order)
    return {"xyz": xyz[keep], "at": at[keep], "labels": labels[keep], "mixed": mixed[keep], "of": np.array([len(xyz), np.count_nonzero(mixed)])}


def clouds(standpoint, models, splits, seed):
    made = f"clouds-{seed}.npz"
    if not os.path.exists(made):
        with open(f"recipe-{seed}.json", "w") as file:
            json.dump(recipe(models, seed, splits), file, indent=1)
        shutil.rmtree("set", ignore_errors=True)
        run(standpoint, "dataset", "run", f"recipe-{seed}.json", "-o", "set", "--threads", "1", losing=True)
        found = {f"{e}/{k}/{name}": values for e in models for k in EFFECTS for name, values in cloud_of("set", e, k, seed).items()}
        np.savez(made, **found)
        shutil.rmtree("set")
    found = np.load(made)
    return {(e, k): {name: found[f"{e}/{k}/{name}"] for name in ("xyz", "at", "labels", "mixed", "of")} for e in models for k in EFFECTS}


def column_heights(xyz, of):
    """From points down to the lowest and up to the highest within reach in their column of half a metre."""
    cells = np.floor((xyz[:, :2] - xyz[:, :2].min(axis=0)) / 0.5).astype(np.int64)
    tall = np.ptp(xyz[:, 2]) + 4 * REACH_M
    column = (cells[:, 0] * (cells[:, 1].max() + 1) + cells[:, 1]) * tall
    height = xyz[:, 2] - xyz[:, 2].min() + 2 * REACH_M
    line = np.sort(column + height)
    here = (column + height)[of]
    lowest = line[np.searchsorted(line, here - REACH_M)]
    highest = line[np.searchsorted(line, here + REACH_M, side="right") - 1]
    return here - lowest, highest - here


def features(cloud, of):
    """Of each point: the shape of its surroundings at four sizes, seen from its scanner, and its heights."""
    xyz, at = cloud["xyz"], cloud["at"]
    below, above = column_heights(xyz, of)
    columns = [xyz[of, 2] - at[of, 2], below, above]
    sight = at[of] - xyz[of]
    for level in range(LEVELS):
        size = CELL_M * 2 ** level
        nodes = middles(xyz, size)
        tree, rows = cKDTree(nodes), []
        for start in range(0, len(of), 20000):
            part = xyz[of[start:start + 20000]]
            near = tree.query(part, NEIGHBOURS, distance_upper_bound=3 * size)[1]
            there = near < len(nodes)
            count = there.sum(axis=1)
            offsets = np.where(there[..., None], nodes[np.minimum(near, len(nodes) - 1)] - part[:, None], 0)
            mean = offsets.sum(axis=1) / np.maximum(count, 1)[:, None]
            covariance = np.einsum("nki,nkj->nij", offsets, offsets) / np.maximum(count, 1)[:, None, None] - mean[:, :, None] * mean[:, None, :]
            values, vectors = np.linalg.eigh(covariance)
            values = np.maximum(values, 1e-12)
            normal = vectors[:, :, 0]
            normal = normal * np.where(np.einsum("ni,ni->n", normal, sight[start:start + 20000]) < 0, -1, 1)[:, None]
            c, b, a = values.T
            share = values / values.sum(axis=1, keepdims=True)
            rows.append(np.column_stack([(a - b) / a, (b - c) / a, c / a, -(share * np.log(share)).sum(axis=1), normal[:, 2], vectors[:, 2, 2] ** 2,
                                         np.where(there, offsets[..., 2], -9).max(axis=1), np.where(there, offsets[..., 2], 9).min(axis=1),
                                         np.linalg.norm(mean, axis=1) / size, count]))
        columns.append(np.concatenate(rows))
    return np.column_stack(columns).astype(np.float32)


def learnt(parts, seed):
    model = HistGradientBoostingClassifier(max_iter=80, max_leaf_nodes=31, learning_rate=0.1, early_stopping=False, random_state=seed)
    return model.fit(np.concatenate([x for x, _ in parts]), np.concatenate([y for _, y in parts]))


def balanced(labels, random):
    drawn = []
    for number in NAMES:
        members = np.flatnonzero(labels == number)
        if number:
            drawn.append(random.permutation(members)[:PER_CLASS])
    return np.concatenate(drawn)


def score(standpoint, truth, predicted, check=False):
    np.save("truth.npy", truth.astype("<u2"))
    np.save("predicted.npy", predicted.astype("<u2"))
    answer = json.loads(run(standpoint, "score", "truth.npy", "predicted.npy", "--classes", "segmentation.json", "--json"))
    if check:
        valid, numbers = truth > 0, list(range(1, len(NAMES)))
        ours = {row["id"]: row["iou"] for row in answer["classes"]}
        theirs = jaccard_score(truth[valid], predicted[valid], labels=numbers, average=None, zero_division=0)
        assert all(abs((ours[n] or 0) - theirs[n - 1]) < 1e-9 for n in numbers)
        assert np.array_equal(np.array(answer["confusion"])[:, :-1], confusion_matrix(truth[valid], predicted[valid], labels=numbers))
    return answer


def by_rules(xyz, seed):
    """The pump thinned and labelled by rules: its floor is the plane of the lowest points; what stands higher than 30 cm is an object; the rest, plinths and
    a deck above, is nobody's. It has no walls."""
    xyz = xyz[thinned(xyz, CELL_M, np.random.default_rng(seed).permutation(len(xyz)))]
    near = xyz[xyz[:, 2] < np.quantile(xyz[:, 2], 0.02) + 0.1]
    for _ in range(5):
        plane = np.linalg.lstsq(np.column_stack([near[:, :2], np.ones(len(near))]), near[:, 2], rcond=None)[0]
        off = xyz[:, 2] - xyz[:, :2] @ plane[:2] - plane[2]
        near = xyz[np.abs(off) < 0.03]
    labels = np.where(off < 0.02, CLASSES["classes"]["floor"], np.where(off > 0.3, CLASSES["classes"]["object"], 0))
    labels[(xyz[:, 2] > 1.2) & (np.linalg.norm(xyz, axis=1) > 4.3)] = 0
    cloud = {"xyz": xyz, "at": np.zeros((len(xyz), 3)), "labels": labels}
    return {**cloud, "features": features(cloud, np.arange(len(xyz)))}


def places_of(file):
    points, pose = read_ply(file)
    return np.stack([points[k] for k in "xyz"], axis=1) - pose[:3]


def real_scans(standpoint, file):
    """The real scan, the same thinned otherwise, and what its surfaces give when they are scanned from the same place in the simulation."""
    if not os.path.exists("twin.ply"):
        for kind in ("ply", "ptx"):
            run(standpoint, "convert", file, "real." + kind, losing=True)
        run(sys.executable, os.path.join(HERE, "scene_of_scan.py"), "real.ptx", "twin.obj")
        shutil.rmtree("twin", ignore_errors=True)
        run(standpoint, "import", "twin.obj", "-o", "twin", "--up", "z", losing=True)
        run(standpoint, "materials", "twin", "--assign", "material:=paint_white")
        run(standpoint, "station", "twin", "--add", "S1", "--at", "0,0,0", "--stand", "free")
        run(standpoint, "scan", "twin", "--instrument", "faro-focus-s350", "--set", "resolution=1/16", "quality=4x", "colour=off", "-o", "twin.ply")
    real, twin = places_of("real.ply"), places_of("twin.ply")
    return {"real": by_rules(real, 1), "again": by_rules(real, 2), "twin": by_rules(twin, 1)}


def judged_real(standpoint, model, scans):
    """Scores on the real scan and on its twin, and how often a point's nearest one in another cloud has the same label."""
    guesses = {name: model.predict(cloud["features"]) for name, cloud in scans.items()}
    answer = {}
    for name in ("real", "twin"):
        truth = scans[name]["labels"]
        answer[name] = short(score(standpoint, truth, guesses[name], check=True))
        objects = guesses[name][truth == CLASSES["classes"]["object"]]
        answer[name]["taken_for"] = (np.bincount(objects, minlength=len(NAMES)) / len(objects)).tolist()
    valid = scans["real"]["labels"] > 0
    for name in ("again", "twin"):
        off, nearest = cKDTree(scans[name]["xyz"]).query(scans["real"]["xyz"][valid])
        close = off < CELL_M
        answer["same_as_" + name] = float((guesses["real"][valid] == guesses[name][nearest])[close].mean())
    return answer


def spread(values):
    values = np.array(values, float)
    return f"{100 * values.mean():.1f} ({100 * values.min():.1f}–{100 * values.max():.1f})"


def tables(figures):
    buildings = list(figures["runs"][0]["each"])
    lines = ["| learnt from | mean IoU | accuracy | mixed points right | " + " | ".join(f"mean IoU of {e}" for e in buildings) + " | on scans like its own |",
             "|---|" + "--:|" * (len(buildings) + 4)]
    for k in EFFECTS:
        rows = [f for f in figures["runs"] if f["effects"] == k]
        columns = [[f["held_out"]["mean_iou"] for f in rows], [f["held_out"]["accuracy"] for f in rows], [f["mixed_right"] for f in rows],
                   *[[f["each"][e] for f in rows] for e in buildings], [f["own"]["mean_iou"] for f in rows]]
        lines.append(f"| {k} | " + " | ".join(map(spread, columns)) + " |")
    classes = [n for n in list(NAMES.values())[1:] if any(f["held_out"]["iou"][n] is not None for f in figures["runs"])]
    lines += ["", "| IoU on scans with all effects | " + " | ".join(classes) + " |", "|---|" + "--:|" * len(classes)]
    for k in EFFECTS:
        rows = [f for f in figures["runs"] if f["effects"] == k]
        lines.append(f"| {k} | " + " | ".join(spread([f["held_out"]["iou"][n] or 0 for f in rows]) for n in classes) + " |")
    if "pump" in figures["runs"][0]:
        lines += ["", "| scan of the pump | | accuracy | IoU floor | IoU object | recall of object | objects taken for, % | same label at the same place |",
                  "|---|---|--:|--:|--:|--:|---|--:|"]
        for k in EFFECTS:
            for name in ("real", "twin"):
                pumps = [f["pump"] for f in figures["runs"] if f["effects"] == k]
                rows = [f[name] for f in pumps]
                taken = np.mean([f["taken_for"] for f in rows], axis=0)
                names = ", ".join(f"{NAMES[n]} {100 * taken[n]:.0f}" for n in np.argsort(-taken) if n != CLASSES["classes"]["object"] and taken[n] > 0.005)
                columns = [[f["accuracy"] for f in rows], *[[f["iou"][n] for f in rows] for n in ("floor", "object")], [f["taken_for"][-1] for f in rows]]
                same = [f["same_as_again" if name == "real" else "same_as_twin"] for f in pumps]
                lines.append(f"| {k} | {name} | " + " | ".join(map(spread, columns)) + f" | {names} | {spread(same)} |")
    return "\n".join(lines) + "\n"


def short(answer):
    return {**{name: answer[name] for name in ("mean_iou", "accuracy", "confusion")}, "iou": {row["class"]: row["iou"] for row in answer["classes"]}}


def picture(cloud, predicted):
    """From the side and above, without what is higher than half a metre over the scanners."""
    xyz, truth = cloud["xyz"], cloud["labels"]
    shown = np.flatnonzero((xyz[:, 2] < np.median(cloud["at"][:, 2]) + 0.5) & (xyz[:, 2] > np.median(cloud["at"][:, 2]) - 2))
    shown = shown[np.argsort(-xyz[shown, 1] + 0.5 * xyz[shown, 2])]
    across, up = xyz[shown, 0] + 0.35 * xyz[shown, 1], 0.65 * xyz[shown, 1] + 0.8 * xyz[shown, 2]
    grey = np.where(((truth != predicted) & (truth > 0))[:, None], COLOURS[predicted], [[.88, .88, .88]])
    figure, axes = plt.subplots(3, 1, figsize=(7, 9.4))
    for plot, title, colours in zip(axes, ("truth", "predicted", "errors, in the colour of the prediction"), (COLOURS[truth], COLOURS[predicted], grey)):
        plot.scatter(across, up, s=2.2, c=colours[shown], linewidths=0)
        plot.set(title=title, aspect="equal", xlim=np.quantile(across, [0.005, 0.995]) + [-0.5, 0.5], ylim=np.quantile(up, [0.002, 0.998]) + [-0.3, 0.3])
        plot.axis("off")
    legend = [plt.Line2D([], [], marker="s", ls="", color=COLOURS[n], label=NAMES[n]) for n in NAMES if n]
    figure.legend(handles=legend, loc="lower center", ncol=7, frameon=False, columnspacing=0.9, handletextpad=0)
    figure.subplots_adjust(left=0, right=1, top=0.96, bottom=0.05, hspace=0.1)
    figure.savefig("segmentation.png", dpi=80)


def main():
    if not 3 <= len(sys.argv) <= 5:
        sys.exit(__doc__)
    standpoint, folder = os.path.abspath(sys.argv[1]), sys.argv[2]
    corpus = os.path.abspath(sys.argv[3]) if len(sys.argv) > 3 and sys.argv[3] != "-" else None
    seeds = int(sys.argv[4]) if len(sys.argv) > 4 else 3
    samples = os.path.join(os.path.dirname(os.path.realpath(standpoint)), "..", "samples")
    train, test = (TRAIN, TEST) if corpus else ({"house": "house.ifc"}, {"street": "street.ifc"})
    models = {k: os.path.join(corpus, "ifc", v) if corpus else os.path.join(samples, v) for k, v in {**train, **test}.items()}
    os.makedirs(folder, exist_ok=True)
    os.chdir(folder)
    with open("segmentation.json", "w") as file:
        json.dump(CLASSES, file, indent=1)
    real = real_scans(standpoint, os.path.join(corpus, REAL)) if corpus else None
    figures, began = {"runs": [], "clouds": {}}, time.time()
    for seed in range(1, seeds + 1):
        found = clouds(standpoint, models, {"train": list(train), "test": list(test)}, seed)
        print(f"seed {seed}: clouds at {time.time() - began:.0f} s", flush=True)
        for (e, k), cloud in found.items():
            figures["clouds"][f"{e} {k} {seed}"] = {
                "points": int(cloud["of"][0]), "mixed": int(cloud["of"][1]), "thinned": len(cloud["xyz"]), "thinned_mixed": int(cloud["mixed"].sum()),
                "classes": np.bincount(cloud["labels"], minlength=len(NAMES)).tolist()}
        random = np.random.default_rng(seed)
        held = {}  # of each set of effects: cloud, features, truth of each held-out building
        for k in EFFECTS:
            held[k] = []
            for e in test:
                of = random.permutation(len(found[e, k]["xyz"]))[:TESTED]
                held[k].append(({name: found[e, k][name][of] for name in ("xyz", "at", "labels", "mixed")}, features(found[e, k], of)))
        truths = {k: np.concatenate([cloud["labels"] for cloud, _ in held[k]]) for k in EFFECTS}
        mixed = np.concatenate([cloud["mixed"] for cloud, _ in held["all"]])
        for k in EFFECTS:
            parts = []
            for e in train:
                chosen = balanced(found[e, k]["labels"], random)
                parts.append((features(found[e, k], chosen), found[e, k]["labels"][chosen]))
            model = learnt(parts, seed)
            guesses = [model.predict(seen) for _, seen in held["all"]]
            guess = np.concatenate(guesses)
            row = {"effects": k, "seed": seed, "held_out": short(score(standpoint, truths["all"], guess, check=True)),
                   "each": {e: score(standpoint, cloud["labels"], part)["mean_iou"] for e, (cloud, _), part in zip(test, held["all"], guesses)},
                   "mixed_right": float((truths["all"] == guess)[mixed].mean()),
                   "own": short(score(standpoint, truths[k], np.concatenate([model.predict(seen) for _, seen in held[k]])))}
            if real:
                row["pump"] = judged_real(standpoint, model, real)
            figures["runs"].append(row)
            with open("figures.json", "w") as file:  # each time, so that a run that is cut off keeps what it found
                json.dump(figures, file, indent=1)
            print(f"seed {seed} {k}: mean IoU {row['held_out']['mean_iou']:.3f}, own {row['own']['mean_iou']:.3f} at {time.time() - began:.0f} s", flush=True)
            if seed == 1 and k == "all":
                picture(held[k][0][0], guesses[0])
    with open("tables.md", "w") as file:
        file.write(tables(figures))
    print(tables(figures))


if __name__ == "__main__":
    main()
