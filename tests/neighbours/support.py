# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests beside other programs share: whether one is there, and the sample house as a project."""
import json
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("skipped: NumPy is not installed (python3-numpy)")
    sys.exit(77)

BUILD = Path(os.environ["STANDPOINT_BUILD"])
HERE = Path(__file__).resolve().parent
PROGRAM = BUILD / "bin/standpoint"
HOUSE = BUILD / "share/standpoint/samples/house.ifc"


def needs(*programs: str) -> None:
    """Ends the test as skipped where one of them is not installed."""
    for program in programs:
        if not shutil.which(program):
            print(f"skipped: {program} is not installed (docs/explanation/neighbours.md)")
            sys.exit(77)


def standpoint(*words: object) -> dict:
    done = subprocess.run([PROGRAM, *map(str, words), "--json", "--allow-loss"], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"standpoint {' '.join(map(str, words))}: {done.stderr or done.stdout}")
    return json.loads(done.stdout)


class Glb:
    """A GLB of ours: its JSON, and what its nodes hold in the model's frame (Z up, below the node that turns it)."""

    def __init__(self, file: Path) -> None:
        data = Path(file).read_bytes()
        length = struct.unpack("<I", data[12:16])[0]
        self.json, self.binary = json.loads(data[20:20 + length]), data[28 + length:]
        self.nodes, self.meshes = self.json["nodes"], self.json["meshes"]
        self.parents = {child: index for index, node in enumerate(self.nodes) for child in node.get("children", [])}

    def products(self) -> dict:
        """Indices of the nodes by GlobalId."""
        return {node["extras"]["global_id"]: i for i, node in enumerate(self.nodes) if "global_id" in node.get("extras", {})}

    def matrix(self, node: int) -> np.ndarray:
        """Of the node in the model's frame."""
        own = np.array(self.nodes[node].get("matrix", np.eye(4).ravel()), float).reshape(4, 4).T
        above = self.parents.get(node)
        return own if above is None or above not in self.parents else self.matrix(above) @ own

    def accessor(self, index: int) -> np.ndarray:
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        kind, width = {5126: "<f4", 5125: "<u4", 5123: "<u2", 5121: "u1"}[accessor["componentType"]], {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
        begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        return np.frombuffer(self.binary, kind, accessor["count"] * width, begin).reshape(-1, width)

    def triangles(self, node: int) -> np.ndarray:
        """Corners of the node's triangles and of its children's, n × 3 × 3."""
        parts = [self.triangles(child) for child in self.nodes[node].get("children", [])]
        if "mesh" in self.nodes[node]:
            matrix = self.matrix(node)
            for part in self.meshes[self.nodes[node]["mesh"]]["primitives"]:
                places = self.accessor(part["attributes"]["POSITION"]).astype(float) @ matrix[:3, :3].T + matrix[:3, 3]
                parts.append(places[self.accessor(part["indices"]).ravel()].reshape(-1, 3, 3))
        return np.concatenate(parts) if parts else np.zeros((0, 3, 3))


def quiet_home() -> dict:
    """Variables of a process that leaves the user's settings alone and asks for no display."""
    home = os.path.abspath("home")
    os.makedirs(home, exist_ok=True)
    return {**os.environ, "HOME": home, "XDG_CONFIG_HOME": home, "XDG_DATA_HOME": home, "XDG_CACHE_HOME": home, "QT_QPA_PLATFORM": "offscreen",
            "OMP_NUM_THREADS": "1"}


class InFolder(unittest.TestCase):
    """All tests of a class in one empty folder, which is the working one."""

    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = tempfile.TemporaryDirectory()
        cls.before = os.getcwd()
        os.chdir(cls.folder.name)

    @classmethod
    def tearDownClass(cls) -> None:
        os.chdir(cls.before)
        cls.folder.cleanup()
