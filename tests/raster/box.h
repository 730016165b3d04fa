#pragma once

#include "raster/surface.h"

namespace grove::raster {

/// A box with flat sides of a colour, standing on y = 0.
[[nodiscard]] Surface makeBox(world::Vec3 size, world::Vec3 albedo);

}  // namespace grove::raster
