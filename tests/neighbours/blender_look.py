# SPDX-License-Identifier: GPL-3.0-or-later
"""Run by Blender (blender -b --python blender_look.py -- FILE... ANSWER): imports each file into an empty scene and tells what is there."""
import json
import sys

import bpy
import mathutils
import numpy

# Blender 3.4 of Debian 12 says numpy.bool in its glTF importer, a word that Debian's NumPy 1.24 has no more.
if not hasattr(numpy, "bool"):
    numpy.bool = bool

*files, answer = sys.argv[sys.argv.index("--") + 1:]


def told(thing: bpy.types.Object) -> dict:
    corners = [thing.matrix_world @ mathutils.Vector(corner) for corner in thing.bound_box]
    return {"name": thing.name, "type": thing.type, "bounds": [[f(c[k] for c in corners) for k in range(3)] for f in (min, max)],
            "triangles": sum(len(p.vertices) - 2 for p in thing.data.polygons) if thing.type == "MESH" else 0,
            "materials": [slot.material.name for slot in thing.material_slots if slot.material],
            "properties": {key: value for key, value in thing.items() if isinstance(value, (str, int, float))},
            "parent": thing.parent.name if thing.parent else None}


scenes = []
for file in files:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if file.endswith(".obj"):
        bpy.ops.wm.obj_import(filepath=file, forward_axis="Y", up_axis="Z")
    else:
        bpy.ops.import_scene.gltf(filepath=file)
    bpy.context.view_layer.update()
    scenes.append({"objects": [told(thing) for thing in bpy.data.objects], "materials": [material.name for material in bpy.data.materials]})
with open(answer, "w") as out:
    json.dump({"version": bpy.app.version_string, "scenes": scenes}, out)
