# SPDX-License-Identifier: GPL-3.0-or-later
"""CloudCompare keeps the national grid of our clouds: it moves them by a global shift, and writes them back where they were.

Every point's place is compared by bench/outside_readers.py; here the bounds, with the walls of a room that nothing else measured.
"""
import itertools
import re
import shutil
import subprocess
import unittest
from pathlib import Path

import numpy as np

from support import InFolder, needs, quiet_home, standpoint

needs("CloudCompare")

ROOM_M = ((456780.33, 5429120.28, 115.1), (456788.33, 5429126.28, 118.1))
FACES = ((1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4))
FORMATS = ("ply", "ptx", "pts", "xyz", "csv", "e57", "las")
TOLERANCE_M = 0.001


def said_by_cloudcompare(*words: str) -> str:
    done = subprocess.run(["CloudCompare", "-SILENT", "-AUTO_SAVE", "OFF", "-NO_TIMESTAMP", "-C_EXPORT_FMT", "ASC", "-PREC", "6", *words],
                          capture_output=True, text=True, env=quiet_home(), timeout=120)
    return done.stdout + done.stderr


def bounds_off(places: np.ndarray) -> float:
    return max(np.abs(places.min(0) - ROOM_M[0]).max(), np.abs(places.max(0) - ROOM_M[1]).max())


class CloudCompare(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        with open("room.obj", "w") as file:
            file.writelines(f"v {x} {y} {z}\n" for x, y, z in itertools.product(*zip(*ROOM_M)))
            file.writelines("f " + " ".join(map(str, face)) + "\n" for face in FACES)
        standpoint("import", "room.obj", "-o", "room", "--up", "z")
        standpoint("station", "room", "--add", "S1", "--at", "456784.2,5429123.1,116.6", "--stand", "free")
        cls.points = standpoint("scan", "room", "--instrument", "faro-focus-s350", "--set", "resolution=1/32", "quality=4x", "colour=off", "--ideal",
                                "-o", "scan.e57")["stations"][0]["points"]

    def read_back(self, extension: str, *shift: str) -> np.ndarray | None:
        """Places that CloudCompare writes, or nothing where it has no reader."""
        folder = Path(extension + "".join(shift))
        folder.mkdir()
        file = folder / f"scan.{extension}"
        if extension == "e57":
            shutil.copy("scan.e57", file)
        else:
            standpoint("convert", "scan.e57", file)
        (folder / "identity.txt").write_text("1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n")
        # It saves what it has changed; a PTX comes as a group of clouds.
        change = ["-MERGE_CLOUDS"] if extension in ("ptx", "e57") else ["-APPLY_TRANS", str(folder / "identity.txt")]
        said = said_by_cloudcompare("-O", *shift, str(file), *change, "-SAVE_CLOUDS")
        if "unhandled file extension" in said:
            return None
        self.shift = re.findall(r"Translation: \((.*?)\)", said)
        written = list(folder.glob("*.asc"))
        self.assertEqual(len(written), 1, said)
        return np.loadtxt(written[0], usecols=(0, 1, 2), comments="//", ndmin=2)

    def test_bounds_come_back(self):
        read = 0
        for extension in FORMATS:
            with self.subTest(format=extension):
                places = self.read_back(extension, "-GLOBAL_SHIFT", "AUTO")
                if places is None:
                    print(f"{extension}: this CloudCompare has no reader")
                    continue
                read += 1
                off = bounds_off(places)
                print(f"{extension}: {len(places)} points, bounds {1000 * off:.3f} mm off; global shift {self.shift[0] if self.shift else 'none'}")
                self.assertTrue(self.shift)
                self.assertEqual(len(places), self.points)
                self.assertLess(off, TOLERANCE_M)
        self.assertGreaterEqual(read, 5)

    def test_without_a_shift_they_would_not(self):
        off = bounds_off(self.read_back("ply"))
        print(f"ply without a shift: {1000 * off:.0f} mm off")
        self.assertGreater(off, 0.05)


if __name__ == "__main__":
    unittest.main()
