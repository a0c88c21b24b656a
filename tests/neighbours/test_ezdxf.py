# SPDX-License-Identifier: GPL-3.0-or-later
"""Drawings that ezdxf writes come in with the materials that it gave to entities, layers and blocks. Skipped without
Debian's python3-ezdxf.
"""
import math
import sys
import unittest
from pathlib import Path

from support import InFolder, standpoint

try:
    import ezdxf
except ImportError:
    print("skipped: ezdxf is not installed (python3-ezdxf)")
    sys.exit(77)

SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
STATED = 0xC2000000  # of a colour in three bytes


def material(drawing: object, name: str, rgb: int | None = None, **more: object) -> str:
    """The handle of a new one; without a colour it has that of the entity."""
    made = drawing.materials.new(name)
    made.dxf.diffuse_color_method = 0 if rgb is None else 1
    if rgb is not None:
        made.dxf.diffuse_color_value = (STATED | rgb) - (1 << 32)
    for what, value in more.items():
        made.dxf.set(what, value)
    return made.dxf.handle


def looks(obj: Path) -> dict:
    """By the middle of each face in plan, in whole tens: name, colour and opacity of its material."""
    materials, corners, found, current = {}, [], {}, None
    for words in (line.split() for line in obj.with_suffix(".mtl").read_text().splitlines()):
        if words[:1] == ["newmtl"]:
            current = materials.setdefault(words[1], {})
        elif words:
            current[words[0]] = words[1:]
    for words in (line.split() for line in obj.read_text().splitlines()):
        if words[:1] == ["v"]:
            corners.append([float(w) for w in words[1:4]])
        elif words[:1] == ["usemtl"]:
            current = words[1]
        elif words[:1] == ["f"]:
            x = sum(corners[int(w.split("/")[0]) - 1][0] for w in words[1:]) / len(words[1:])
            kd, opacity = materials[current]["Kd"], float(materials[current].get("d", ["1"])[0])
            found[math.floor(x / 10)] = (current, tuple(round(255 * float(c)) for c in kd), round(opacity, 2))
    return found


class Ezdxf(InFolder):
    def test_materials_are_those_of_entities_layers_and_blocks(self):
        for release in ("R2007", "R2010", "R2013", "R2018"):
            drawing = ezdxf.new(release)
            drawing.header["$INSUNITS"] = 6
            brick, glass = material(drawing, "Brick", 0xB04030), material(drawing, "Glass", 0x80C0FF, opacity=0.25)
            paint, dim = material(drawing, "Paint"), material(drawing, "Dim", 0xC8A064, diffuse_color_factor=0.5)
            drawing.layers.add("Walls", color=3).dxf.material_handle = brick
            drawing.layers.add("Doors", color=1)
            special = {name: made.dxf.handle for name, made in drawing.materials}
            block = drawing.blocks.new("Leaf")
            block.add_3dface(SQUARE, dxfattribs={"material_handle": special["ByBlock"]})
            space = drawing.modelspace()
            for number, (layer, handle) in enumerate((("Walls", None), ("Walls", special["ByLayer"]), ("Walls", glass), ("Doors", paint),
                                                      ("Doors", None), ("Doors", special["Global"]), ("Doors", dim))):
                face = space.add_3dface([(10 * number + x, y, z) for x, y, z in SQUARE], dxfattribs={"layer": layer})
                if handle:
                    face.dxf.material_handle = handle
            space.add_blockref("Leaf", (70, 0, 0), dxfattribs={"layer": "Doors", "material_handle": glass})
            drawing.saveas("drawing.dxf")
            answer = standpoint("import", "drawing.dxf", "-o", release, "--shift", "none")
            self.assertEqual([i for i in answer["issues"] if i["severity"] != "note"], [], release)
            standpoint("export", release, "-o", f"{release}.obj")
            red, glass_look = (255, 0, 0), ("Glass", (0x80, 0xC0, 0xFF), 0.25)
            self.assertEqual(looks(Path(f"{release}.obj")),
                             {0: ("Brick", (0xB0, 0x40, 0x30), 1), 1: ("Brick", (0xB0, 0x40, 0x30), 1), 2: glass_look, 3: ("Paint", red, 1),
                              4: ("Doors", red, 1), 5: ("Doors", red, 1), 6: ("Dim", (0x64, 0x50, 0x32), 1), 7: glass_look}, release)


if __name__ == "__main__":
    unittest.main(verbosity=2)
