"""The default world's fire and smoke, moved by Blender's Mantaflow: a picture to hold Grove's against. See README.md."""
import math
import os
import pathlib
import sys
import tempfile
import time

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
sys.dont_write_bytecode = True
import cycles_light  # noqa: E402
from grove import FIRE, FLUID, turned  # noqa: E402

# Grove's own, and where they are.
BUOYANCY, LIFE = 16.0, 4.6  # metres per second squared; seconds, mean: fluid_simulation.cpp
COVER = 0.005  # square metres that a sprite hides, mean below 3 m: smoke_shading_kernels.cpp, smoke_sprites_kernels.cpp
SHARE = 1 / 7  # of the fire's light that its sprites show: the same files, and FIRE

# Mantaflow's. The cube is the middle of Grove's; cells of 6 cm (noise: 3 cm) show what Grove's 19 cm miss.
CUBE, CELLS, FINER = 6.0, 96, 2  # metres, cells per edge, noise cells per cell
LIFT = 6.0  # fitted: the front rises 2 metres per second; Grove's smoke, 1.8 (kCurlPace in smoke_curls_kernels.h)
WIND, WHIRLS = 0.08, 3.0  # fitted by eye
FPS, FRAMES = 30, 84  # ends before smoke leaves the cube


def add_modifier(kind, settings, **values):
    modifier = bpy.context.object.modifiers.new("Fluid", "FLUID")
    modifier.fluid_type = kind
    for name, value in values.items():
        setattr(getattr(modifier, settings), name, value)
    return bpy.context.object


def add_fluid(cache):
    # The source is as sourceOf() in fluid_simulation.cpp has it.
    bpy.ops.mesh.primitive_uv_sphere_add(location=(0, 0, FLUID["size"] / FLUID["grid"]))
    bpy.context.object.scale = FLUID["radius"] * np.array((1, 1, 0.3))
    bpy.context.object.hide_render = True
    add_modifier("FLOW", "flow_settings", flow_type="BOTH", flow_behavior="INFLOW", surface_distance=0.5, volume_density=1)
    wind = turned(FLUID["wind"])
    bpy.ops.object.effector_add(type="WIND", rotation=(0.5 * math.pi, 0, math.atan2(wind[1], wind[0]) + 0.5 * math.pi))
    bpy.context.object.field.strength = WIND
    bpy.ops.object.effector_add(type="TURBULENCE", location=(0, 0, 1))
    bpy.context.object.field.strength, bpy.context.object.field.size = WHIRLS, 1.3
    bpy.context.scene.gravity = (0, 0, -LIFT * BUOYANCY)
    bpy.ops.mesh.primitive_cube_add(size=CUBE, location=(0, 0, 0.5 * CUBE))
    sides = {f"use_collision_border_{side}": False for side in ("front", "back", "left", "right", "top")}
    # Vorticity, burning rate and strength of the noise are fitted by eye.
    return add_modifier("DOMAIN", "domain_settings", domain_type="GAS", cache_directory=cache, cache_type="REPLAY",
                        cache_frame_end=FRAMES, resolution_max=CELLS, use_adaptive_domain=True, alpha=1, beta=1,
                        vorticity=0.08, burning_rate=1.1, flame_smoke=1, flame_vorticity=0.1, flame_ignition=0.7,
                        flame_max_temp=1.2, use_noise=True, noise_scale=FINER, noise_strength=0.6, **sides)


def amounts(domain):
    """Extinction per density and radiance per flame squared: in total, as much as Grove's sprites hide and show by then."""
    grids = domain.evaluated_get(bpy.context.evaluated_depsgraph_get()).modifiers[0].domain_settings
    cell, seconds = (CUBE / CELLS / FINER) ** 3, FRAMES / FPS
    hidden = COVER * FLUID["rate"] * seconds * (1 - 0.5 * seconds / LIFE)
    shown = SHARE * math.pi * FIRE["colour"][0]
    return hidden / (np.sum(grids.density_grid) * cell), shown / (np.sum(np.square(grids.flame_grid)) * cell)


def main(folder, out, backdrop=None):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps, bpy.context.scene.frame_end = FPS, FRAMES
    domain = add_fluid(folder)
    times = [time.monotonic()]
    for frame in range(1, FRAMES + 1):
        bpy.context.scene.frame_set(frame)
    times.append(time.monotonic())
    cycles_light.add_material(domain, *amounts(domain))
    cycles_light.add_lights()
    cycles_light.save(out, cycles_light.render(f"{folder}/light.exr", backdrop is not None), backdrop)
    times.append(time.monotonic())
    print(f"Mantaflow: {times[1] - times[0]:.0f} s, Cycles: {times[2] - times[1]:.0f} s")


paths = [os.path.abspath(path) for path in sys.argv[sys.argv.index("--") + 1:]]
with tempfile.TemporaryDirectory() as scratch:
    os.chdir(scratch)  # Mantaflow leaves a file where it starts
    main(scratch, *paths)
