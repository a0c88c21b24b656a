# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of Python's module share. Importing it ends the test as skipped where NumPy is not installed."""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import numpy  # noqa: F401
except ImportError:
    print("skipped: NumPy is not installed (python3-numpy)")
    sys.exit(77)

BUILD = Path(os.environ["STANDPOINT_BUILD"])
SOURCE = Path(__file__).resolve().parents[2]
PROGRAM = BUILD / "bin/standpoint"
HOUSE = BUILD / "share/standpoint/samples/house.ifc"
#: of a scan of a few thousand points
FEW = {"resolution": "12mm", "field_of_view": "target_area", "horizontal_from": 0, "horizontal_to": 20,
       "vertical_from": -10, "vertical_to": 10, "images": "off"}


def command(*words: object) -> subprocess.CompletedProcess:
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=True)


class InFolder(unittest.TestCase):
    """Each test in an empty folder of its own, which is the working one."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        before = os.getcwd()
        os.chdir(folder.name)
        self.addCleanup(os.chdir, before)


def house_with_station(name: str = "house") -> str:
    import standpoint

    standpoint.import_(HOUSE, output=name)
    standpoint.station(name, add="S1", on=(4.3, 1.6))
    return name
