# SPDX-License-Identifier: GPL-3.0-or-later
"""Godot 3 imports our model with its collision shapes; a body of Godot's walks through every door, and a closed one stops it."""
import json
import math
import subprocess
import time
import unittest
from pathlib import Path

from support import HERE, HOUSE, Glb, InFolder, needs, quiet_home, standpoint

needs("godot3-server")

BODY = {"radius_m": 0.3, "height_m": 1.8, "speed_m_s": 1.4, "most_steps": 200}  # of 1/60 s; the way takes 103
BESIDE_M, ABOVE_M = 1.2, 0.05
# Godot 3 makes each convex shape larger by its margin, 4 cm unless it is set.
GIVEN_MARGIN_M, LEAST_MARGIN_M = 0.04, 0.001
# The toilet stands where one walk in the bathroom begins and the other would end.
FURNISHED = "Bathroom door"
FILE_SECONDS = 120  # half a minute is usual


def walks_through(doors: list, model: Glb) -> list:
    """Both ways through the middle of each door, in Godot's frame (Y up)."""
    walks = []
    for door in doors:
        across, (x, y, z) = model.matrix(model.products()[door["global_id"]])[:3, 1], door["at"]
        ends = [[x + side * BESIDE_M * across[0], z + ABOVE_M, -(y + side * BESIDE_M * across[1])] for side in (-1, 1)]
        walks += [{"door": door["name"], "way": "there", "from": ends[0], "to": ends[1]},
                  {"door": door["name"], "way": "back", "from": ends[1], "to": ends[0]}]
    return walks


def imported(project: Path) -> int:
    return len(list((project / ".import").glob("*.md5")))


def import_once(project: Path, wanted: int) -> bool:
    """Godot's editor does not end by itself: it is ended when the sums of all files are there, or where no more come."""
    editor = subprocess.Popen(["godot3-server", "--path", project, "-e", "-q"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=quiet_home())
    try:
        found, since = imported(project), time.monotonic()
        while found < wanted:
            if editor.poll() is not None or time.monotonic() - since > FILE_SECONDS:
                print(f"Godot's editor had imported {found} of {wanted} files when it was ended")
                return False
            time.sleep(0.2)
            if imported(project) > found:
                found, since = imported(project), time.monotonic()
        return True
    finally:
        editor.kill()
        editor.wait()


def import_all(project: Path) -> float:
    """Seconds. Of some twenty imports one hung without importing anything, so another may follow."""
    wanted, began = len(list(project.glob("*.glb"))), time.monotonic()
    for _ in range(3):
        if import_once(project, wanted):
            return time.monotonic() - began
    raise RuntimeError(f"Godot imported {imported(project)} of {wanted} files")


def walk_all(project: Path, tasks: list) -> list:
    (project / "walks.json").write_text(json.dumps(tasks))
    with open("said", "wb") as said:  # a fault in the script is told without end
        subprocess.run(["bash", "-c", 'ulimit -f 2000; exec timeout 60 godot3-server --path "$0" --fixed-fps 60 -s walk.gd', project], stdout=said,
                       stderr=said, env=quiet_home())
    if not (project / "answer.json").exists():
        raise RuntimeError("Godot did not answer: " + Path("said").read_bytes()[:2000].decode(errors="replace"))
    answers = json.loads((project / "answer.json").read_text())
    for task, answer in zip(tasks, answers):
        print(f"{answer['scene']}, margin {1000 * task['margin_m']:.0f} mm: {answer['nodes']}")
        for walk, found in zip(task["walks"], answer["walks"]):
            way, gone = ([b - a for a, b in zip(walk["from"], there)] for there in (walk["to"], found["at"]))
            length = math.hypot(way[0], way[2])
            found.update(walk, gone_m=(way[0] * gone[0] + way[2] * gone[2]) / length, rise_m=gone[1] + ABOVE_M)
            found["arrived"] = found["gone_m"] > length - 0.01
            print(f"  {found['door']:20} {found['way']:5} {found['gone_m']:.2f} m in {found['steps']:.0f} steps, {1000 * found['rise_m']:+.0f} mm above the "
                  f"sill{'' if found['arrived'] else ', stopped'}", flush=True)
    return answers


class Godot(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        project = Path("godot").absolute()
        project.mkdir()
        (project / "project.godot").write_text("config_version=4\n")
        (project / "walk.gd").write_text((HERE / "godot_walk.gd").read_text())
        standpoint("import", HOUSE, "-o", "house")
        cls.shapes, walks = {}, {}
        for doors in ("open", "closed"):
            collided = standpoint("collide", "house", "--doors", doors)
            file = project / f"{doors}.glb"
            cls.shapes[doors] = standpoint("export", "house", "-o", file, "--collision", "godot")["collision_shapes"]
            walks[doors] = walks_through(collided["doors"], Glb(file))
        print(f"Godot's import of both: {import_all(project):.0f} s")
        tasks = [{"scene": f"{doors}.glb", "margin_m": margin, "walks": walks[doors], **BODY}
                 for doors, margin in (("open", LEAST_MARGIN_M), ("open", GIVEN_MARGIN_M), ("closed", LEAST_MARGIN_M))]
        cls.open, cls.open_as_given, cls.closed = walk_all(project, tasks)

    def test_every_shape_is_a_body(self):
        for shapes, answer in ((self.shapes["open"], self.open), (self.shapes["closed"], self.closed)):
            self.assertEqual(answer["nodes"]["StaticBody"], shapes)
            self.assertEqual(answer["nodes"]["CollisionShape"], shapes)
        self.assertGreater(self.shapes["closed"], self.shapes["open"])

    def test_a_body_walks_through_every_open_door(self):
        self.assertEqual(len(self.open["walks"]), 16)
        for walk in self.open["walks"]:
            with self.subTest(door=walk["door"], way=walk["way"]):
                self.assertTrue(walk["arrived"] or walk["door"] == FURNISHED and walk["gone_m"] > BESIDE_M + 0.5, walk)
                self.assertLess(abs(walk["rise_m"]), 0.05)

    def test_it_passes_with_the_margin_as_given_too(self):
        for walk in self.open_as_given["walks"]:
            self.assertGreater(walk["gone_m"], BESIDE_M + 0.5, walk)

    def test_a_closed_door_stops_it(self):
        self.assertEqual(len(self.closed["walks"]), 16)
        for walk in self.closed["walks"]:
            self.assertLess(walk["gone_m"], BESIDE_M - BODY["radius_m"] + 0.01, walk)


if __name__ == "__main__":
    unittest.main()
