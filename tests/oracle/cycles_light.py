"""Lights smoke and flames as Grove's default world does, with Cycles."""
import math

import bpy
import numpy as np
from grove import STONES, turned

# Grove's own, and where they are.
EYE, YAW = (2.0, 1.7, 1.5), 50  # `fire` in tests/browser/pictures.mjs; kEyeHeight in world/players.h
SIZE, FOV = (1280, 720), 1.05  # kSize in pictures.mjs; verticalFov in world/camera.h
SUN, SUN_COLOUR = (-0.46, 0.185, -0.87), (1.90, 1.12, 0.54)  # this and the next line: world/sky.h
ZENITH, HAZE, GLOW, GROUND = (0.13, 0.21, 0.40), (0.44, 0.385, 0.41), (1.55, 0.80, 0.30), (0.13, 0.10, 0.06)
COOL, HOT = (1, 0.07, 0.006, 1), (1, 0.28, 0.056, 1)  # flames: smoke_shading_kernels.cpp
ALBEDO, FORWARD = 0.91, 0.3  # dense smoke then reflects half the light: smoke_shading_kernels.cpp

SAMPLES = 48  # Cycles' own


def add_material(domain, density, power):
    """Smoke and flames: extinction per density, radiance per flame squared."""
    material = bpy.data.materials.new("Smoke")
    material.use_nodes = True
    nodes, link = material.node_tree.nodes, material.node_tree.links.new
    nodes.clear()

    def grid(name):
        node = nodes.new("ShaderNodeAttribute")
        node.attribute_name = name
        return node.outputs["Fac"]

    def calculate(operation, *values):
        node = nodes.new("ShaderNodeMath")
        node.operation = operation
        for value, socket in zip(values, node.inputs):
            if isinstance(value, bpy.types.NodeSocket):
                link(value, socket)
            else:
                socket.default_value = value
        return node.outputs[0]

    flame, ramp = grid("flame"), nodes.new("ShaderNodeValToRGB")
    ramp.color_ramp.elements[0].color, ramp.color_ramp.elements[1].color = COOL, HOT
    link(flame, ramp.inputs[0])
    clear = calculate("MAXIMUM", 0.25, calculate("MULTIPLY_ADD", flame, -2.25, 1.0))  # hot gas is clear, as in Grove
    volume = nodes.new("ShaderNodeVolumePrincipled")
    for name, value in {"Color": (ALBEDO, ALBEDO, ALBEDO, 1), "Anisotropy": FORWARD, "Density Attribute": ""}.items():
        volume.inputs[name].default_value = value
    link(calculate("MULTIPLY", calculate("MULTIPLY", grid("density"), density), clear), volume.inputs["Density"])
    link(calculate("MULTIPLY", calculate("POWER", flame, 2.0), power), volume.inputs["Emission Strength"])
    link(ramp.outputs[0], volume.inputs["Emission Color"])
    link(volume.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Volume"])
    domain.data.materials.append(material)


def add_lights(width=512, height=256):
    towards = turned(SUN) / math.hypot(*SUN)
    turn = (math.acos(towards[2]), 0, math.atan2(towards[1], towards[0]) + 0.5 * math.pi)
    bpy.ops.object.light_add(type="SUN", rotation=turn)
    sun = bpy.context.object.data
    sun.angle, sun.color, sun.energy = math.radians(0.5), SUN_COLOUR, math.pi
    for stone in STONES:  # boxes give their shadows
        bpy.ops.mesh.primitive_cube_add(size=1, location=turned(stone["position"]) + (0, 0, 0.5 * stone["height"]))
        bpy.context.object.scale = (stone["width"], stone["depth"], stone["height"])
        bpy.context.object.rotation_euler[2] = math.radians(stone["yaw_degrees"])
        bpy.context.object.visible_camera = False
    # Sky::radiance() of world/sky.cpp, above a ground of one colour.
    yaw, pitch = np.meshgrid(np.linspace(math.pi, -math.pi, width), np.linspace(-math.pi / 2, math.pi / 2, height))
    ways = np.stack([np.cos(pitch) * np.cos(yaw), np.cos(pitch) * np.sin(yaw), np.sin(pitch)], -1)
    up, c4 = np.maximum(ways[..., 2:], 0), np.maximum(ways @ towards, 0)[..., None] ** 4
    haze = HAZE + np.array(GLOW) * (0.36 * c4 + 0.30 * c4**4)
    sky = haze + (ZENITH - haze) * (1 - np.exp(-3.4 * up)) + np.array(GLOW) * 0.35 * c4**16 * (1 - np.exp(-20 * up))
    sky = np.where(ways[..., 2:] < 0, GROUND, sky)
    world = bpy.context.scene.world = bpy.data.worlds.new("Sky")
    world.use_nodes = True
    texture = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
    texture.image = image_of(sky, float_buffer=True, is_data=True)
    world.node_tree.links.new(texture.outputs["Color"], world.node_tree.nodes["Background"].inputs["Color"])


def image_of(colours, **options):
    image = bpy.data.images.new("Image", colours.shape[1], colours.shape[0], **options)
    image.pixels.foreach_set(np.dstack([colours, np.ones(colours.shape[:2])]).astype(np.float32).ravel())
    return image


def pixels_of(path):
    image = bpy.data.images.load(path)
    if path.endswith(".png"):
        image.colorspace_settings.name = "Non-Color"
    return np.array(image.pixels[:], np.float32).reshape(image.size[1], image.size[0], 4)


def render(path, transparent):
    """Renders the middle half of Grove's picture and returns it: linear RGBA, from the bottom row up."""
    scene = bpy.context.scene
    bpy.ops.object.camera_add(location=turned(EYE), rotation=(0.5 * math.pi, 0, math.radians(YAW)))
    scene.camera = bpy.context.object
    scene.camera.data.sensor_fit, scene.camera.data.angle = "VERTICAL", FOV
    scene.cycles.samples, scene.cycles.volume_bounces, scene.cycles.sample_clamp_indirect = SAMPLES, 4, 1.0
    scene.cycles.use_denoising = False
    picture = scene.render
    picture.engine, picture.film_transparent, picture.filepath = "CYCLES", transparent, path
    picture.image_settings.file_format = "OPEN_EXR"
    picture.resolution_x, picture.resolution_y, picture.resolution_percentage = *SIZE, 100
    picture.use_border, picture.use_crop_to_border = True, True
    picture.border_min_x, picture.border_max_x, picture.border_min_y, picture.border_max_y = 0.25, 0.75, 0, 1
    bpy.ops.render.render(write_still=True)
    return calmed(pixels_of(path))


def calmed(light, reach=5, patch=2, noise=0.06):
    """Takes out the path tracer's noise by non-local means (Buades et al. 2005); Blender may lack a denoiser."""

    def mean(values):
        for axis in (0, 1):
            values = sum(np.roll(values, by, axis) for by in range(-patch, patch + 1)) / (2 * patch + 1)
        return values

    tones, total, weights = np.sqrt(np.maximum(light, 0)), np.zeros_like(light), 0
    shifts = range(-reach, reach + 1)
    for shift in ((y, x) for y in shifts for x in shifts):
        difference = mean(((np.roll(tones, shift, (0, 1)) - tones) ** 2).mean(-1))
        weight = np.exp(-np.maximum(difference / noise**2 - 1, 0))[..., None]
        total, weights = total + weight * np.roll(light, shift, (0, 1)), weights + weight
    return total / weights


def to_display(linear):
    """As in world/light.cpp."""
    x = 0.7 * np.maximum(linear, 0)
    mapped = np.clip(x * (2.51 * x + 0.14) / (x * (2.43 * x + 0.59) + 0.14), 0, 1)
    return np.where(mapped <= 0.0031308, 12.92 * mapped, 1.055 * mapped ** (1 / 2.4) - 0.055)


def save(out, light, backdrop):
    """Saves as Grove shows it: in front of its own picture, if there is one."""
    colour = light[..., :3]
    if backdrop:
        steps = np.linspace(0, 9, 20000)
        behind = pixels_of(backdrop)[:, SIZE[0] // 4 : SIZE[0] * 3 // 4, :3]
        colour = colour + (1 - light[..., 3:]) * np.interp(behind, to_display(steps), steps)
    picture = image_of(to_display(colour))
    picture.filepath_raw, picture.file_format = out, "PNG"
    picture.save()
