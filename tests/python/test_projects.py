# SPDX-License-Identifier: GPL-3.0-or-later
"""A project that stays in memory gives what the command line gives, to the byte."""
import hashlib
import os
import threading
import unittest
from pathlib import Path

import numpy as np
from support import FEW, HOUSE, InFolder, command, house_with_station

import standpoint


def bytes_of(folder: str) -> dict:
    return {str(file.relative_to(folder)): hashlib.sha256(file.read_bytes()).hexdigest()
            for file in sorted(Path(folder).rglob("*")) if file.is_file() and file.name != ".lock"}


class Projects(InFolder):
    def test_scans_and_projects_have_the_bytes_of_the_command_line(self):
        os.makedirs("a")
        os.makedirs("b")
        settings = [f"{key}={value}" for key, value in FEW.items()]
        command("import", HOUSE, "-o", "a/house")
        command("materials", "a/house")
        command("station", "a/house", "--add", "S1", "--on", "4.3,1.6")
        os.chdir("a")
        for seed in ("1", "2"):
            command("scan", "house", "--instrument", "leica-rtc360", "--set", *settings, "--truth", "--seed", seed,
                    "-o", f"s{seed}.e57")
        os.chdir("../b")
        standpoint.import_(HOUSE, output="house")
        house = standpoint.Project("house")
        house.materials()
        house.station(add="S1", on=(4.3, 1.6))
        for seed in (1, 2):  # the second has the scene of the first
            house.scan(instrument="leica-rtc360", set=FEW, truth=True, seed=seed, output=f"s{seed}.e57")
        os.chdir("..")
        self.assertEqual(bytes_of("a"), bytes_of("b"))

    def test_what_another_wrote_meanwhile_is_seen_and_kept(self):
        house_with_station()
        house = standpoint.Project("house")
        house.station(add="S2", on=(5.3, 1.6))
        command("station", "house", "--add", "S3", "--on", "4.3,2.6")
        house.station(add="S4", on=(5.3, 2.6))
        listed = [row["name"] for row in standpoint.station("house")["stations"]]
        self.assertEqual(sorted(listed), ["S1", "S2", "S3", "S4"])

    def test_threads_may_share_a_project(self):
        house_with_station()
        house = standpoint.Project("house")
        made = [threading.Thread(target=house.bookmark, kwargs={"add": f"view {i}"}) for i in range(6)]
        for thread in made:
            thread.start()
        for thread in made:
            thread.join()
        self.assertEqual(len(house.bookmark()["bookmarks"]), 6)

    def test_products_are_those_of_the_model(self):
        answer = standpoint.import_(HOUSE, output="house")
        house = standpoint.Project("house")
        self.assertEqual(house.products["global_id"].tolist(), [row["global_id"] for row in answer["products"]])
        self.assertEqual(house.products["ifc_class"].tolist(), [row["class"] for row in answer["products"]])
        self.assertTrue(house.products["in_scene"].any())

    def test_a_mesh_has_the_figures_of_its_products(self):
        answer = standpoint.import_(HOUSE, output="house")
        house = standpoint.Project("house")
        house.materials()
        mesh = house.mesh()
        there = [row for row, in_scene in zip(answer["products"], mesh.products["in_scene"]) if in_scene]
        self.assertEqual(len(mesh.faces), sum(row["triangles"] for row in there))
        for array in (mesh.vertices, mesh.faces, mesh.product, mesh.material):
            self.assertFalse(array.flags.owndata)
            self.assertFalse(array.flags.writeable)
        self.assertEqual((mesh.vertices.dtype, mesh.faces.dtype), (np.float64, np.uint32))
        corners = mesh.vertices[mesh.faces]
        measured = 0
        for i, row in enumerate(answer["products"]):
            own = corners[mesh.product == i]
            if row not in there or row["triangles"] == 0:
                self.assertEqual(len(own), 0)
                continue
            self.assertEqual(len(own), row["triangles"], row)
            np.testing.assert_allclose(own.reshape(-1, 3).min(axis=0), row["bounds"][0], atol=1e-4)
            np.testing.assert_allclose(own.reshape(-1, 3).max(axis=0), row["bounds"][1], atol=1e-4)
            if row["volume"]:  # outwards: the volume is positive
                volume = np.einsum("ij,ij->i", own[:, 0], np.cross(own[:, 1], own[:, 2])).sum() / 6
                self.assertAlmostEqual(volume, row["volume"], delta=1e-3 + 1e-3 * row["volume"])
                measured += 1
        self.assertGreater(measured, 10)
        area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
        stated = {row["material"]: row["area_m2"] for row in house.materials()["materials"]}
        for i, material in enumerate(mesh.materials):
            self.assertAlmostEqual(area[mesh.material == i].sum(), stated[material], delta=0.01 * stated[material])

    def test_a_project_is_a_path(self):
        house = standpoint.Project(house_with_station())
        self.assertEqual(os.fspath(house), os.path.abspath("house"))
        self.assertEqual(standpoint.info(house)["format"], "project")
        self.assertTrue(standpoint.station(house)["stations"])
        with self.assertRaises(standpoint.FileSystemError):
            standpoint.Project("nowhere")


if __name__ == "__main__":
    unittest.main()
