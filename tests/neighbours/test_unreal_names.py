# SPDX-License-Identifier: GPL-3.0-or-later
"""`--collision unreal` keeps Unreal's rule: a shape of the mesh NAME is called UCX_NAME_01, _02, …, is convex, and lies where the mesh lies."""
import re
import unittest
from collections import defaultdict
from pathlib import Path

import numpy as np

from support import HOUSE, Glb, InFolder, standpoint

WORD = re.compile(r"[A-Za-z0-9_]+")
NAME = re.compile(r"UCX_(.+)_(\d{2,})")
DEVIATION_M = 0.0105  # what a shape may be off its part, and rounding
NOT_CONVEX = {"Terrain"}  # Unreal would make a hull of it, so it has no shape


def depth_of_dents(triangles: np.ndarray) -> float:
    """How far a corner lies before the plane of another triangle; what is thinner than 0.1 mm has no plane to speak of."""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    edges = np.linalg.norm(triangles - np.roll(triangles, 1, axis=1), axis=2).max(axis=1)
    good = lengths > 1e-4 * edges
    corners = np.unique(triangles.reshape(-1, 3), axis=0)
    return max(((corners - base) @ normal).max() for normal, base in zip(normals[good] / lengths[good, None], triangles[good, 0]))


class UnrealNames(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        standpoint("import", HOUSE, "-o", "house")
        collided = standpoint("collide", "house")
        cls.exported = standpoint("export", "house", "-o", "house.glb", "--collision", "unreal")
        cls.written, cls.computed = cls.exported["collision_shapes"], sum(product["shapes"] for product in collided["products"])
        cls.model = Glb(Path("house.glb"))
        cls.shapes = defaultdict(list)  # by the name of the mesh: number, node
        for index, node in enumerate(cls.model.nodes):
            if node.get("name", "").startswith("UCX_"):
                match = NAME.fullmatch(node["name"])
                cls.shapes[match.group(1) if match else None].append((int(match.group(2)) if match else 0, index))

    def test_each_name_follows_the_rule(self):
        self.assertNotIn(None, self.shapes)
        meshes = [mesh["name"] for mesh in self.model.meshes]
        nodes = [node.get("name") for node in self.model.nodes]
        for name, shapes in self.shapes.items():
            self.assertRegex(name, WORD)
            self.assertEqual(meshes.count(name), 1, name)
            self.assertEqual(nodes.count(name), 1, name)
            self.assertEqual(sorted(number for number, _ in shapes), list(range(1, len(shapes) + 1)), name)
            for number, index in shapes:
                self.assertEqual(self.model.meshes[self.model.nodes[index]["mesh"]]["name"], f"UCX_{name}_{number:02}")

    def test_shapes_belong_to_products(self):
        with_shapes = {self.model.nodes[i]["name"] for i in self.model.products().values()} & set(self.shapes)
        self.assertEqual(with_shapes, set(self.shapes))
        found = sum(map(len, self.shapes.values()))
        print(f"{found} shapes of {len(self.shapes)} meshes; {self.written - found} more belong to products that share one of these meshes")
        self.assertGreater(found, 200)
        self.assertLessEqual(found, self.written)

    def test_shapes_lie_where_their_mesh_lies_and_are_convex(self):
        index_of = {node.get("name"): i for i, node in enumerate(self.model.nodes)}
        dented = set()
        for name, shapes in self.shapes.items():
            drawn = self.model.triangles(index_of[name]).reshape(-1, 3)
            for _, index in shapes:
                triangles = self.model.triangles(index)
                self.assertTrue((triangles.min(axis=(0, 1)) > drawn.min(axis=0) - DEVIATION_M).all(), name)
                self.assertTrue((triangles.max(axis=(0, 1)) < drawn.max(axis=0) + DEVIATION_M).all(), name)
                if depth_of_dents(triangles) > 0.002:
                    dented.add(re.sub(r"_\d+$", "", name))
        self.assertEqual(dented, set())

    def test_what_is_not_convex_has_no_shape_and_is_named(self):
        names = {node.get("name") for node in self.model.nodes}
        for name in NOT_CONVEX:
            self.assertIn(name, names, "its mesh is there, under its own name")
            self.assertFalse([found for found in self.shapes if re.fullmatch(rf"{name}_\d+", found)])
        self.assertEqual(self.written, self.computed - len(NOT_CONVEX))
        told = [issue["message"] for issue in self.exported["issues"] if "not convex" in issue["message"]]
        self.assertEqual(len(told), 1)
        for name in NOT_CONVEX:
            self.assertIn(f"({name})", told[0])


if __name__ == "__main__":
    unittest.main()
