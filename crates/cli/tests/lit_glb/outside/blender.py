"""Imports a lit GLB into Blender, and prints as JSON what is in it and how bright it is drawn."""

import json
import os
import sys
import tempfile

import bpy

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=sys.argv[1])
objects = {}
for thing in bpy.data.objects:
    if thing.type != "MESH":
        continue
    light = thing.data.attributes.get("_RADIOSITY")
    colours = thing.data.color_attributes
    objects[thing.name] = {
        "faces": len(thing.data.polygons),
        "light": light and [list(entry.vector) for entry in light.data],
        "colours": len(colours[0].data) if colours else 0,
        "materials": [material.name for material in thing.data.materials],
    }
scene = bpy.context.scene
scene.camera = next(thing for thing in bpy.data.objects if thing.type == "CAMERA")
scene.render.engine = "CYCLES"
scene.cycles.device = "CPU"
scene.cycles.samples = 4
scene.render.resolution_x, scene.render.resolution_y = 80, 64
scene.view_settings.view_transform = "Standard"
with tempfile.TemporaryDirectory() as folder:
    scene.render.filepath = os.path.join(folder, "picture.png")
    bpy.ops.render.render(write_still=True)
    picture = bpy.data.images.load(scene.render.filepath)
    pixels = list(picture.pixels)
lit = [max(pixels[i : i + 3]) for i in range(0, len(pixels), 4)]
print("RESULT " + json.dumps({"objects": objects, "mean": sum(lit) / len(lit)}))
