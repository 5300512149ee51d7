"""Draws scenes with Cycles, run by Blender for compare_cycles.py: blender -b --python cycles_pictures.py -- JOBS.json

JOBS.json: {"jobs": [...], "arrays": [[picture, array], ...]}. After the jobs each picture is read and its linear RGBA
saved as a numpy array, top row first: Blender is the one reader of OpenEXR that is at hand for certain.
"""
import json
import math
import sys

import bpy
import numpy as np

if not hasattr(np, "bool"):
    np.bool = bool  # Blender 3.4's glTF add-on still says so; numpy 1.24 does not know it any more


def shader_nodes(material, mode, emission):
    """Rebuilds an imported material from its four numbers."""
    nodes, links = material.node_tree.nodes, material.node_tree.links
    imported = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    base = tuple(imported.inputs["Base Color"].default_value)
    metallic = imported.inputs["Metallic"].default_value
    roughness = imported.inputs["Roughness"].default_value
    nodes.clear()

    def principled(base_color, metalness):
        node = nodes.new("ShaderNodeBsdfPrincipled")
        node.distribution = "MULTI_GGX"
        for name, value in (("Base Color", base_color), ("Metallic", metalness), ("Roughness", roughness),
                            ("Specular", 0.5)):
            node.inputs[name].default_value = value
        return node.outputs["BSDF"]

    def joined(kind, first, second, factor=None):
        node = nodes.new(kind)
        if factor is not None:
            node.inputs[0].default_value = factor
        links.new(first, node.inputs[-2])
        links.new(second, node.inputs[-1])
        return node.outputs[0]

    if mode == "principled":
        surface = principled(base, metallic)
    else:  # Lambert's diffuse reflection in the place of Disney's
        diffuse = nodes.new("ShaderNodeBsdfDiffuse")
        diffuse.inputs["Color"].default_value = base
        dielectric = joined("ShaderNodeAddShader", diffuse.outputs["BSDF"], principled((0, 0, 0, 1), 0))
        surface = joined("ShaderNodeMixShader", dielectric, principled(base, 1), metallic)
    if any(emission):
        light = nodes.new("ShaderNodeEmission")
        light.inputs["Color"].default_value = (*emission, 1)
        surface = joined("ShaderNodeAddShader", surface, light.outputs[0])
    links.new(surface, nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])


def load(job):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=job["scene"])
    scene = bpy.context.scene
    for material in bpy.data.materials:
        if material.use_nodes:
            shader_nodes(material, job["materials"], job["emission"].get(material.name, (0, 0, 0)))
    for thing in bpy.data.objects:
        if thing.type == "MESH":  # seen by the camera alone: neither shadows nor reflections of one another
            thing.visible_diffuse = thing.visible_glossy = thing.visible_transmission = thing.visible_shadow = False
        elif thing.type == "CAMERA":
            scene.camera = thing
            thing.data.sensor_fit = "VERTICAL"
            if job["yfov"]:
                thing.data.angle_y = job["yfov"]
        elif thing.type == "LIGHT":
            light = thing.data
            # The add-on divides by 683 lm/W and, for spots, by the cone. Blender's watts are over the whole sphere.
            intensity = job["lights"][light.name.split(".")[0]]
            light.energy = intensity if light.type == "SUN" else 4 * math.pi * intensity
            light.shadow_soft_size = 0
            if light.type == "SUN":
                light.angle = 0
            if light.type == "SPOT":
                light.spot_blend = 0
    scene.world = bpy.data.worlds.new("light")
    scene.world.use_nodes = True
    background = scene.world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (0, 0, 0, 1)
    if job["environment"]:
        # Blender's axes are (x, -z, y) of glTF's, and its column of a direction becomes facet's: nothing to turn.
        texture = scene.world.node_tree.nodes.new("ShaderNodeTexEnvironment")
        texture.image = bpy.data.images.load(job["environment"])
        scene.world.node_tree.links.new(texture.outputs["Color"], background.inputs["Color"])
    return scene


def draw(job):
    scene = load(job)
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = job["size"]
    scene.render.resolution_percentage = 100
    scene.render.film_transparent = True
    scene.render.threads_mode, scene.render.threads = "FIXED", job["threads"]
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_mode = "RGBA"
    scene.render.image_settings.color_depth = "32"
    scene.view_settings.view_transform = "Raw"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = job["samples"]
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.max_bounces = 0
    cycles.caustics_reflective = cycles.caustics_refractive = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = cycles.light_sampling_threshold = 0
    cycles.pixel_filter_type = "BOX"
    for seed, picture in enumerate(job["pictures"]):
        cycles.seed = seed
        scene.render.filepath = picture
        bpy.ops.render.render(write_still=True)


def save_array(picture, array):
    image = bpy.data.images.load(picture)
    image.colorspace_settings.name = "Non-Color"
    image.alpha_mode = "CHANNEL_PACKED"  # as it stands in the file
    pixels = np.empty(image.size[0] * image.size[1] * 4, dtype=np.float32)
    image.pixels.foreach_get(pixels)
    np.save(array, pixels.reshape(image.size[1], image.size[0], 4)[::-1])


def main():
    with open(sys.argv[sys.argv.index("--") + 1], encoding="utf-8") as file:
        work = json.load(file)
    for job in work["jobs"]:
        draw(job)
    for picture, array in work["arrays"]:
        save_array(picture, array)


main()
