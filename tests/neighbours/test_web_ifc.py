# SPDX-License-Identifier: GPL-3.0-or-later
"""web-ifc finds in our IFC what it finds in the file that the model came from: GlobalIds, classes, names, places, types, materials,
properties with the types of their values, places on the map, and meshes where they were.

STANDPOINT_WEB_IFC is a folder in which `npm install web-ifc` was run; skipped without it.
"""
import json
import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np

from support import HERE, HOUSE, Glb, InFolder, needs, standpoint

MODULES = os.environ.get("STANDPOINT_WEB_IFC")
if not MODULES:
    print("skipped: STANDPOINT_WEB_IFC is not set (docs/explanation/neighbours.md)")
    sys.exit(77)
needs("node")

PLACE_M = 1e-5  # web-ifc computes in float
ROUND_M = 0.002  # its circles have other corners than ours
SLIVER_M2 = 1e-7  # it drops smaller triangles
LEFT_OUT = ("IfcOpeningElement", "IfcGrid", "IfcAnnotation")

# Each kind of property that is not a single value, from id 900000 on, for the object in {}.
KINDS = """#900001=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);
#900002=IFCPROPERTYENUMERATEDVALUE('Status',$,(IFCLABEL('NEW'),IFCLABEL('30')),$);
#900003=IFCPROPERTYLISTVALUE('Widths',$,(IFCLENGTHMEASURE(12.),IFCLENGTHMEASURE(15.5)),#900001);
#900004=IFCPROPERTYBOUNDEDVALUE('Range',$,IFCREAL(8.),IFCREAL(2.),$,IFCREAL(5.));
#900005=IFCPROPERTYBOUNDEDVALUE('Least',$,$,IFCPOWERMEASURE(2.),$,$);
#900006=IFCPROPERTYSINGLEVALUE('Deep',$,IFCINTEGER(7),$);
#900007=IFCCOMPLEXPROPERTY('Inner',$,'Inner',(#900006,#900003));
#900008=IFCCOMPLEXPROPERTY('Outer',$,'Outer',(#900007,#900006));
#900009=IFCPROPERTYSET('0000000000000000900009',$,'Kinds',$,(#900002,#900003,#900004,#900005,#900008));
#900010=IFCRELDEFINESBYPROPERTIES('0000000000000000900010',$,$,$,({}),#900009);
#900011=IFCQUANTITYAREA('Net',$,$,9.5,$);
#900012=IFCPHYSICALCOMPLEXQUANTITY('Layer',$,(#900011),'Layer',$,$);
#900013=IFCELEMENTQUANTITY('0000000000000000900013',$,'Kinds of quantities',$,$,(#900011,#900012));
#900014=IFCRELDEFINESBYPROPERTIES('0000000000000000900014',$,$,$,({}),#900013);
"""


def found(file: object) -> dict:
    done = subprocess.run(["node", HERE / "web_ifc_look.cjs", MODULES, file], capture_output=True, text=True, check=True, timeout=120)
    return json.loads(done.stdout)


def off(a: list, b: list) -> float:
    return max(abs(x - y) for x, y in zip(a, b))


def areas(triangles: np.ndarray) -> np.ndarray:
    return np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1) / 2


class WebIfc(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        standpoint("import", HOUSE, "-o", "house")
        standpoint("materials", "house", "--rules", "default")
        cls.answer = standpoint("export", "house", "-o", "out.ifc")
        cls.source, cls.written = found(HOUSE), found("out.ifc")
        cls.pairs = {g: (o, cls.written["objects"].get(g)) for g, o in cls.source["objects"].items() if o["class"] not in LEFT_OUT}

    def test_every_object_is_there_with_its_global_id_class_name_and_tag(self):
        self.assertGreater(len(self.pairs), 90)
        for global_id, (before, after) in self.pairs.items():
            self.assertIsNotNone(after, f"{before['class']} {global_id}")
            for what in ("class", "name", "tag", "place", "whole", "type", "materials"):
                self.assertEqual(after[what], before[what], f"{what} of {before['class']} {global_id}")
            self.assertIn(before["predefined"], (after["predefined"], None, "NOTDEFINED"))

    def test_properties_keep_their_sets_values_and_types(self):
        compared = 0
        for global_id, (before, after) in self.pairs.items():
            for name, rows in before["sets"].items():
                self.assertIn(name, after["sets"], f"{before['class']} {global_id}")
                self.assertEqual(after["sets"][name], rows, f"{name} of {before['class']} {global_id}")
                compared += len(rows)
        self.assertGreater(compared, 80)

    def test_lists_bounds_and_complex_properties_are_what_they_were(self):
        text = HOUSE.read_text()
        wall, global_id = re.search(r"(#\d+)=IFCWALL\('([^']+)'", text).groups()
        head, tail = text.rsplit("ENDSEC;", 1)
        Path("kinds.ifc").write_text(head + KINDS.format(wall, wall) + "ENDSEC;" + tail)
        standpoint("import", "kinds.ifc", "-o", "kinds")
        standpoint("export", "kinds", "-o", "kinds_out.ifc")
        before, after = (found(file)["objects"][global_id]["sets"] for file in ("kinds.ifc", "kinds_out.ifc"))
        kinds = {name: row[0] for name, row in before["Kinds"].items()}
        self.assertEqual(kinds, {"Status": "IfcPropertyEnumeratedValue", "Widths": "IfcPropertyListValue", "Range": "IfcPropertyBoundedValue",
                                 "Least": "IfcPropertyBoundedValue", "Outer": "IfcComplexProperty"})
        self.assertEqual(after["Kinds"], before["Kinds"])
        self.assertEqual(before["Kinds of quantities"]["Layer"], ["IfcPhysicalComplexQuantity", {"Net": ["IfcQuantityArea", 9.5, None]}, None])
        self.assertEqual(after["Kinds of quantities"], before["Kinds of quantities"])

    def test_meshes_are_where_they_were(self):
        standpoint("export", "house", "-o", "house.glb")
        glb = Glb(Path("house.glb"))
        shaped = 0
        triangles, expected = 0, 0
        for global_id, node in glb.products().items():
            corners = glb.triangles(node).reshape(-1, 3)
            if not len(corners):
                continue
            shaped += 1
            triangles += self.pairs[global_id][1]["triangles"]
            expected += np.count_nonzero(areas(corners.reshape(-1, 3, 3)) > SLIVER_M2)
            before, after = self.pairs[global_id]
            for end, value in (("min", corners.min(0)), ("max", corners.max(0))):
                self.assertLess(off(after[end], value), PLACE_M, f"{after['class']} {global_id}")
                self.assertLess(off(after[end], before[end]), ROUND_M, f"{after['class']} {global_id}")
        self.assertGreater(shaped, 85)
        self.assertEqual(triangles, expected)
        self.assertGreater(self.answer["triangles"], triangles)  # rooms, which web-ifc does not stream

    def test_the_place_on_the_map_is_the_same(self):
        self.assertEqual(self.written["map"], self.source["map"])
        self.assertEqual(self.written["schema"], "IFC4")


if __name__ == "__main__":
    unittest.main(verbosity=2)
