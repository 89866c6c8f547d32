"""Lights the scene by Blender's Cycles: bakes the diffuse light of every input triangle.

Each triangle has its own square cell of one float image. Its legs are n + 1/2 texels long: the
n (n + 1) / 2 texels whose centres lie inside then have the triangle's area and centroid, so that
their mean is that of the triangle to second order. An effort `n:s` is cells of n texels a side
and s samples a texel. The time of a run is that of the bake call, which prepares the scene too;
a bake of one sample goes before.
"""

import math

import bpy
import numpy as np

import common

LADDER = "8:1,8:4,16:4,32:4,32:16,64:16,64:64"


def configure(threads):
    """Cycles on the processor, with nothing that would trade bias for noise."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    if threads:
        scene.render.threads_mode = "FIXED"
        scene.render.threads = threads
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_denoising = False
    cycles.use_adaptive_sampling = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.max_bounces = cycles.diffuse_bounces = 64
    bake = scene.render.bake
    bake.margin = 0
    bake.use_clear = True
    bake.use_pass_direct = bake.use_pass_indirect = bake.use_pass_color = True
    return scene


def one_sided(name, triangle):
    """A material that reflects and emits in front and is black behind."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, link = material.node_tree.nodes, material.node_tree.links.new
    nodes.clear()
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (*triangle.reflectance, 1)
    front = diffuse.outputs[0]
    if any(triangle.radiance):
        emission = nodes.new("ShaderNodeEmission")
        emission.inputs["Color"].default_value = (*triangle.radiance, 1)
        both = nodes.new("ShaderNodeAddShader")
        link(front, both.inputs[0])
        link(emission.outputs[0], both.inputs[1])
        front = both.outputs[0]
        material.cycles.emission_sampling = "FRONT"
    black = nodes.new("ShaderNodeBsdfDiffuse")
    black.inputs["Color"].default_value = (0, 0, 0, 1)
    side = nodes.new("ShaderNodeMixShader")
    link(nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"], side.inputs[0])
    link(front, side.inputs[1])
    link(black.outputs[0], side.inputs[2])
    link(side.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    nodes.active = nodes.new("ShaderNodeTexImage")
    return material


def build(scene, triangles):
    """The scene as one object; every triangle keeps its own corners."""
    mesh = bpy.data.meshes.new("scene")
    corners = [corner for triangle in triangles for corner in triangle.corners]
    mesh.from_pydata(corners, [], [range(3 * i, 3 * i + 3) for i in range(len(triangles))])
    mesh.uv_layers.new(name="cells")
    slots = {}
    for polygon, triangle in zip(mesh.polygons, triangles):
        key = (triangle.reflectance, triangle.radiance)
        if key not in slots:
            slots[key] = len(slots)
            mesh.materials.append(one_sided(f"material {slots[key]}", triangle))
        polygon.material_index = slots[key]
    thing = bpy.data.objects.new("scene", mesh)
    scene.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    thing.select_set(True)
    return mesh


def cells(count, side):
    """Where each triangle's cell begins, in texels, and the side of the image."""
    columns = math.ceil(math.sqrt(count))
    pitch = side + 2
    return [(i % columns * pitch, i // columns * pitch) for i in range(count)], columns * pitch


def lay_out(mesh, count, side):
    """Gives each triangle its cell of a new image, and returns the image."""
    origins, size = cells(count, side)
    uv = mesh.uv_layers["cells"].data
    leg = side + 0.5
    for triangle, (x, y) in enumerate(origins):
        for corner, (u, v) in enumerate([(0, 0), (leg, 0), (0, leg)]):
            uv[3 * triangle + corner].uv = ((x + u) / size, (y + v) / size)
    image = bpy.data.images.new("exitance", size, size, alpha=False, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    for material in mesh.materials:
        material.node_tree.nodes.active.image = image
    return image


def exitance(image, count, side):
    """Mean exitance that each triangle reflects: pi times the radiance of its texels."""
    origins, size = cells(count, side)
    texels = np.empty(size * size * 4, np.float32)
    image.pixels.foreach_get(texels)
    texels = texels.reshape(size, size, 4)
    row, column = np.mgrid[0:side, 0:side]
    inside = row + column < side
    return [
        math.pi * texels[y : y + side, x : x + side, :3][inside].mean(axis=0, dtype=float)
        for x, y in origins
    ]


def bake(scene, samples, seed):
    """Bakes into the image that the materials name."""
    scene.cycles.samples = samples
    scene.cycles.seed = seed
    bpy.ops.object.bake(type="DIFFUSE")


def main():
    args = common.light_arguments(__doc__, LADDER).parse_args()
    triangles = common.read_obj(args.scene)
    scene = configure(args.threads)
    mesh = build(scene, triangles)

    points = []
    for effort in args.ladder.split(","):
        side, samples = (int(x) for x in effort.split(":"))
        image = lay_out(mesh, len(triangles), side)
        bake(scene, 1, 0)
        place = common.point(effort, side * (side + 1) // 2 * samples * len(triangles))
        for run in range(args.runs):
            _, seconds = common.timed(lambda: bake(scene, samples, run))
            solution = common.solution_path(args.work, effort, run)
            common.write_solution(solution, triangles, exitance(image, len(triangles), side))
            common.add_run(place, seconds, solution)
        points.append(place)
        bpy.data.images.remove(image)
    common.write_json(args.out, {"version": bpy.app.version_string, "points": points})


if __name__ == "__main__":
    main()
