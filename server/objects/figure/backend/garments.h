#pragma once

#include "raster/surface.h"

/// What a figure wears, feet at the origin, looking along -Z. Cloth takes the drawing's tint.
namespace grove::objects::figure {

/// From neck to calf, in folds, open in front over a belted tunic.
[[nodiscard]] raster::Surface makeCloak();
/// The short cape over the shoulders, in points.
[[nodiscard]] raster::Surface makeMantle();
/// Pointed, with a deep opening.
[[nodiscard]] raster::Surface makeHood();
/// What one sees of the face inside the hood.
[[nodiscard]] raster::Surface makeFace();

}  // namespace grove::objects::figure
