#pragma once

#include "raster/image.h"
#include "world/camera.h"

namespace grove::objects::figure {

/// Metres around a place that its shadow reaches.
inline constexpr float kShadowRadius = 0.42F;

/// Lays a soft round shadow on the ground around `place`, behind what the picture shows already. `picture` is of that
/// camera; what would be beyond its rectangle is left out.
void layContactShadow(world::Vec3 place, const world::Camera& camera, raster::Image& picture);

}  // namespace grove::objects::figure
