# SPDX-License-Identifier: GPL-3.0-or-later
"""What BLAINDER makes of our glTF: points by IFC class and by material, from one place in a room.

    standpoint export PROJECT -o model.glb
    blender -b --factory-startup --python-exit-code 1 --python bench/blainder_labels.py -- BLAINDER model.glb X,Y,Z OUTDIR

BLAINDER is a checkout of github.com/ln-12/blainder-range-scanner; OUTDIR gets its CSV. BLAINDER labels a point by its object's property categoryID, else
by the object's name, and by partID, else by the material's name; our glTF has the IFC class as categoryID, which the import keeps as a property.
"""
import collections
import csv
import math
import pathlib
import sys
import time

import bpy
import numpy

if not hasattr(numpy, "bool"):  # see tests/neighbours/blender_look.py
    numpy.bool = bool

if sys.argv.count("--") != 1 or len(sys.argv) - sys.argv.index("--") != 5:
    sys.exit(__doc__)
blainder, model, place, folder = sys.argv[sys.argv.index("--") + 1:]
sys.path.insert(0, blainder)
import range_scanner  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=model)
camera = bpy.data.objects.new("scanner", bpy.data.cameras.new("scanner"))
camera.location = [float(word) for word in place.split(",")]
camera.rotation_euler = (math.radians(90), 0, 0)
bpy.context.collection.objects.link(camera)
bpy.context.view_layer.update()

range_scanner.register()
pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
began = time.monotonic()
range_scanner.ui.user_interface.scan_rotating(
    bpy.context, scannerObject=camera, xStepDegree=1.0, fovX=360.0, yStepDegree=1.0, fovY=100.0, rotationsPerSecond=1, reflectivityLower=0.0,
    distanceLower=0.0, reflectivityUpper=0.0, distanceUpper=1e5, maxReflectionDepth=10, enableAnimation=False, frameStart=1, frameEnd=1, frameStep=1,
    frameRate=1, addNoise=False, noiseType="gaussian", mu=0.0, sigma=0.0, noiseAbsoluteOffset=0.0, noiseRelativeOffset=0.0, simulateRain=False,
    rainfallRate=0.0, addMesh=False, exportLAS=False, exportHDF=False, exportCSV=True, exportPLY=False, exportSingleFrames=False, dataFilePath=folder,
    dataFileName="scan", debugLines=False, debugOutput=False, outputProgress=False, measureTime=False, singleRay=False, destinationObject=None,
    targetObject=None)
seconds = time.monotonic() - began

targets = [thing for thing in bpy.context.view_layer.objects if thing.type == "MESH" and thing.active_material]
categories, parts = ({number: name for name, number in numbers.items()} for numbers in range_scanner.scanners.generic.getTargetIndices(targets, False))
with open(next(pathlib.Path(folder).glob("*.csv")), newline="") as file:
    rows = list(csv.DictReader(file, delimiter=";"))
print(f"{len(rows)} points in {seconds:.2f} s")
for title, names, column in (("class", categories, "categoryID"), ("part", parts, "partID")):
    counts = collections.Counter(names[int(float(row[column]))] for row in rows)
    print(f"{title}: " + ", ".join(f"{name} {count}" for name, count in counts.most_common()))
