# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender imports our glTF and OBJ: every product with its name, place, size, materials, and in glTF its GlobalId."""
import json
import re
import subprocess
import unittest

from support import HERE, HOUSE, Glb, InFolder, needs, quiet_home, standpoint

needs("blender")

PLACE_M = 1e-4


def without_number(name: str) -> str:
    """Blender numbers what has the same name."""
    return re.sub(r"\.\d{3}$", "", name)


def union(boxes: list) -> list:
    return [[f(box[i][k] for box in boxes) for k in range(3)] for i, f in enumerate((min, max))]


class Blender(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        imported = standpoint("import", HOUSE, "-o", "house")
        standpoint("materials", "house")
        standpoint("export", "house", "-o", "house.glb")
        standpoint("export", "house", "-o", "house.obj", "--physical")
        done = subprocess.run(["blender", "-b", "-t", "1", "--factory-startup", "--python-exit-code", "1", "--python", HERE / "blender_look.py", "--",
                               "house.glb", "house.obj", "answer.json"], capture_output=True, text=True, env=quiet_home(), timeout=300)
        if done.returncode != 0:
            raise RuntimeError((done.stderr or done.stdout)[-2000:])
        with open("answer.json") as file:
            answer = json.load(file)
        cls.glb = Glb("house.glb")
        cls.products = {p["global_id"]: p for p in imported["products"] if p["global_id"] in cls.glb.products()}
        cls.gltf, cls.obj = answer["scenes"]
        meshes = sum(thing["type"] == "MESH" for thing in cls.gltf["objects"])
        print(f"Blender {answer['version']}: glTF {len(cls.gltf['objects'])} objects, {meshes} with a mesh, {len(cls.gltf['materials'])} materials; "
              f"OBJ {len(cls.obj['objects'])} objects, {len(cls.obj['materials'])} materials")

    def boxes_of(self, thing: dict) -> list:
        children = [box for child in self.gltf["objects"] if child["parent"] == thing["name"] for box in self.boxes_of(child)]
        return children + ([thing["bounds"]] if thing["type"] == "MESH" else [])

    def test_every_product_is_an_object_with_its_properties(self):
        found = {thing["properties"]["global_id"]: thing for thing in self.gltf["objects"] if "global_id" in thing["properties"]}
        self.assertEqual(set(found), set(self.products))
        self.assertGreater(len(found), 50)
        worst = 0
        for global_id, product in self.products.items():
            thing = found[global_id]
            self.assertEqual(without_number(thing["name"]), product["name"])
            self.assertEqual(thing["properties"]["ifc_class"], product["class"])
            self.assertEqual(thing["properties"].get("storey", ""), product["storey"])
            box = union(self.boxes_of(thing))
            worst = max(worst, *(abs(a - b) for ours, theirs in zip(product["bounds"], box) for a, b in zip(ours, theirs)))
        print(f"{len(found)} products, bounds at most {1000 * worst:.4f} mm off")
        self.assertLess(worst, PLACE_M)

    def test_what_a_beam_can_meet_has_its_class_for_blainder(self):
        classes = {thing["name"]: thing["properties"].get("ifc_class") for thing in self.gltf["objects"]}
        pieces = 0
        for thing in self.gltf["objects"]:
            if thing["type"] == "MESH":
                pieces += thing["properties"].get("ifc_class") is None
                self.assertEqual(thing["properties"].get("categoryID"), classes[thing["name"]] or classes[thing["parent"]], thing["name"])
        print(f"{pieces} of the objects with a mesh are pieces of a product")

    def test_materials_keep_their_names(self):
        self.assertEqual(sorted(map(without_number, self.gltf["materials"])), sorted(m["name"] for m in self.glb.json["materials"]))

    def test_obj_has_the_physical_materials(self):
        named = {m["extensions"]["STANDPOINT_physical_material"]["id"] for m in self.glb.json["materials"] if "extensions" in m and
                 "STANDPOINT_physical_material" in m["extensions"]}
        print("physical materials in Blender:", ", ".join(sorted(self.obj["materials"])))
        self.assertEqual(set(map(without_number, self.obj["materials"])), named)
        self.assertEqual(sum(thing["triangles"] for thing in self.obj["objects"]), sum(thing["triangles"] for thing in self.gltf["objects"]))


if __name__ == "__main__":
    unittest.main()
