#pragma once

#include <optional>

#include "objects/figure/backend/shadow/sun_shadow.h"
#include "raster/image.h"
#include "world/camera.h"

namespace grove::objects::figure {

/// The pixels of the camera's image around a figure with these bounds and around its shadow.
[[nodiscard]] world::Rect rectOf(const world::Bounds& figure, const std::optional<SunShadow>& sun,
                                 const world::Camera& camera);

/// Draws the shadows on the ground of a figure at `place`, behind the picture's existing contents. `picture` belongs to
/// `camera`; the shadows are clipped to its rectangle.
void layShadows(world::Vec3 place, const std::optional<SunShadow>& sun, const world::Camera& camera,
                raster::Image& picture);

}  // namespace grove::objects::figure
