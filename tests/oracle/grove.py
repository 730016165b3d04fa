"""What Grove's default world says of its fire."""
import pathlib
import tomllib

import numpy as np

SCENE = tomllib.loads((pathlib.Path(__file__).parents[2] / "server/world/scenes/grove.toml").read_text())
FLUID = next(o for o in SCENE["object"] if o["type"] == "fluid")
STONES = [o for o in SCENE["object"] if o.get("shape") in ("stone", "lintel")]
FIRE = SCENE["light"][0]


def turned(vector):
    """From Grove's axes (east, up, south) to Blender's (east, north, up)."""
    return np.array((vector[0], -vector[2], vector[1]))
