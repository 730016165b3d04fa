#pragma once

#include "raster/image.h"
#include "world/camera.h"

namespace grove::objects::figure {

/// Radius of the shadow around a place. Metres.
inline constexpr float kShadowRadius = 0.42F;

/// Draws a soft round shadow on the ground around `place`, behind the picture's existing contents. `picture` belongs to
/// `camera`; the shadow is clipped to its rectangle.
void layContactShadow(world::Vec3 place, const world::Camera& camera, raster::Image& picture);

}  // namespace grove::objects::figure
