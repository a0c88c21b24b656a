# SPDX-License-Identifier: GPL-3.0-or-later
"""Points are those that other readers find, and arrays view memory of C++ for as long as one of them is there."""
import gc
import re
import shutil
import tempfile
import unittest

import numpy as np
from support import FEW, InFolder, command, house_with_station

import standpoint

TYPES = {"char": "i1", "uchar": "u1", "int": "<i4", "float": "<f4", "double": "<f8"}


def read_ply(file: str) -> np.ndarray:
    """A binary PLY, by what its header says."""
    with open(file, "rb") as stream:
        data = stream.read()
    head, body = data.split(b"end_header\n", 1)
    lines = head.decode().split("\n")
    count = int(next(line for line in lines if line.startswith("element vertex")).split()[-1])
    fields = [line.split()[1:] for line in lines if line.startswith("property")]
    return np.frombuffer(body, dtype=[(name, TYPES[kind]) for kind, name in fields], count=count)


class Clouds(InFolder):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        project = house_with_station(folder.name + "/house")
        cls.scanned = folder.name + "/s.e57"
        standpoint.scan(project, instrument="leica-rtc360", set=FEW, truth=True, output=cls.scanned)

    def setUp(self):
        super().setUp()
        shutil.copy(self.scanned, "s.e57")

    def test_points_are_those_that_numpy_finds_in_a_ply(self):
        command("convert", "s.e57", "s.ply", "--allow-loss")
        ply = read_ply("s.ply")
        scan = standpoint.read_cloud("s.e57")[0]
        self.assertGreater(len(scan), 1000)
        self.assertEqual(len(ply), len(scan))
        for axis, name in enumerate("xyz"):
            np.testing.assert_array_equal(scan.xyz[:, axis], ply[name])
            np.testing.assert_array_equal(scan.true_xyz[:, axis], ply["scalar_True" + name.upper()])
        for column, name in {"intensity": "scalar_Intensity", "material": "scalar_Label", "product": "scalar_Product",
                             "row": "scalar_Row", "column": "scalar_Column", "time_s": "scalar_Time",
                             "return_number": "scalar_ReturnNumber", "true_range_m": "scalar_TrueRange",
                             "incidence_rad": "scalar_Incidence", "received_db": "scalar_ReceivedPower",
                             "flags": "scalar_Flags"}.items():
            np.testing.assert_array_equal(scan[column], ply[name], column)

    def test_labels_are_those_of_the_tables_in_a_ply(self):
        command("convert", "s.e57", "s.ply", "--allow-loss")
        with open("s.ply", "rb") as stream:
            head = stream.read().split(b"end_header", 1)[0].decode()
        rows = [line.split("\t")[1:] for line in re.findall(r"^comment standpoint (product\t.*)$", head, flags=re.M)]
        scan = standpoint.read_cloud("s.e57")[0]
        self.assertEqual([list(row) for row in scan.products.tolist()], [row[1:] for row in rows])
        self.assertEqual(scan.products.dtype.names, ("id", "global_id", "ifc_class", "name"))
        seen = set(scan.products["ifc_class"][np.unique(scan["product"])])
        self.assertTrue(any(c.startswith("IfcWall") for c in seen), seen)
        self.assertIn("concrete", " ".join(scan.materials) + " concrete")

    def test_every_format_that_is_written_is_read(self):
        whole = standpoint.read_cloud("s.e57")[0]
        for extension, off in (("ptx", 0.0002), ("ply", 0.0), ("pcd", 0.0), ("las", 0.0002), ("pts", 0.0001),
                               ("xyz", 0.0001), ("csv", 0.0001)):
            command("convert", "s.e57", f"s.{extension}", "--allow-loss")
            scan = standpoint.read_cloud(f"s.{extension}", allow_loss=True)[0]
            self.assertEqual(len(scan), len(whole), extension)
            if extension in ("ptx", "pcd"):  # of a grid, whose points have an order of their own
                found, expected = np.sort(scan.xyz, axis=0), np.sort(whole.xyz, axis=0)
            else:
                found, expected = scan.xyz, whole.xyz
            self.assertLessEqual(np.abs(found - expected).max(), off + 1e-5, extension)

    def test_text_that_numpy_reads_has_the_same_places(self):
        command("convert", "s.e57", "s.xyz", "--allow-loss")
        text = np.loadtxt("s.xyz")
        scan = standpoint.read_cloud("s.xyz", allow_loss=True)[0]
        self.assertLess(np.abs(text[:, :3] - scan.xyz).max(), 1e-5)
        self.assertEqual(scan.columns.keys() & {"product", "flags"}, set())

    def test_columns_view_memory_of_the_scan(self):
        scan = standpoint.read_cloud("s.e57")[0]
        for name, column in {**scan.columns, "xyz": scan.xyz}.items():
            self.assertFalse(column.flags.owndata, name)
            self.assertFalse(column.flags.writeable, name)
            self.assertEqual(type(column.base).__name__, "PyCapsule", name)
            self.assertEqual(len(column), len(scan), name)
        again = scan._scan.columns()
        self.assertEqual(again["intensity"].__array_interface__["data"][0],
                         scan["intensity"].__array_interface__["data"][0])
        with self.assertRaises(ValueError):
            scan["intensity"][0] = 1
        self.assertEqual(scan["flags"].dtype, np.uint8)
        self.assertEqual(scan["x_m"].dtype, np.float32)
        self.assertEqual(scan.xyz.dtype, np.float64)

    def test_an_array_outlives_its_cloud(self):
        cloud = standpoint.read_cloud("s.e57")
        intensity = cloud[0]["intensity"]
        before = intensity.sum(dtype=float)
        xyz, middle = cloud[0].xyz, cloud[0].xyz.mean(axis=0)
        del cloud
        gc.collect()
        filler = [np.ones(len(intensity), np.float32) for _ in range(20)]  # what was freed would be written over
        self.assertEqual(intensity.sum(dtype=float), before)
        np.testing.assert_array_equal(xyz.mean(axis=0), middle)
        del filler

    def test_the_pose_takes_the_scanners_frame_into_the_files(self):
        scan = standpoint.read_cloud("s.e57")[0]
        local = np.column_stack([scan["x_m"], scan["y_m"], scan["z_m"]]).astype(float)
        placed = local @ scan.file_from_scanner[:3, :3].T + scan.file_from_scanner[:3, 3]
        self.assertLess(np.abs(placed - scan.xyz).max(), 1e-9)

    def test_flags_have_names(self):
        scan = standpoint.read_cloud("s.e57")[0]
        mixed = (scan["flags"] & standpoint.PointFlag.MIXED) != 0
        self.assertGreater(mixed.sum(), 0)
        self.assertLess(mixed.mean(), 0.5)
        off = np.linalg.norm(scan.xyz - scan.true_xyz, axis=1)
        self.assertGreater(off[mixed].max(), off[~mixed].mean())
        self.assertIn("MIXED", repr(standpoint.PointFlag(int(scan["flags"][mixed][0]))))

    def test_a_missing_column_is_an_error_that_lists_those_that_are_there(self):
        scan = standpoint.read_cloud("s.e57")[0]
        with self.assertRaises(KeyError) as caught:
            scan["colour"]
        self.assertIn("intensity", str(caught.exception))
        self.assertIn("flags", scan)

    def test_what_cannot_be_read_is_refused_with_its_place(self):
        with self.assertRaises(standpoint.UsageError):
            standpoint.read_cloud("s.doc")
        with self.assertRaises(standpoint.FileSystemError) as caught:
            standpoint.read_cloud("missing.e57")
        self.assertIn("missing.e57", caught.exception.place)
        with open("s.e57", "rb") as whole, open("cut.e57", "wb") as cut:
            cut.write(whole.read(5000))
        with self.assertRaises(standpoint.UnusableError) as caught:
            standpoint.read_cloud("cut.e57")
        self.assertIn("cut.e57", caught.exception.place)


if __name__ == "__main__":
    unittest.main()
