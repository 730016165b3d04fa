#pragma once

#include "raster/surface.h"

/// A figure's clothes, feet at the origin, facing -Z. Cloth takes the drawing's tint.
namespace grove::objects::figure {

/// From neck to calf, with folds, open in front over a belted tunic.
[[nodiscard]] raster::Surface makeCloak();
/// A short cape over the shoulders with a pointed hem.
[[nodiscard]] raster::Surface makeMantle();
/// Pointed, with a deep opening.
[[nodiscard]] raster::Surface makeHood();
/// The part of the face that the hood shows.
[[nodiscard]] raster::Surface makeFace();

}  // namespace grove::objects::figure
