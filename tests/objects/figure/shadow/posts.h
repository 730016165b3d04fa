#pragma once

#include "objects/figure/backend/shadow/shadow_grid.h"
#include "objects/figure/backend/shadow/shadow_mask.h"
#include "raster/surface.h"

namespace grove::objects::figure {

inline constexpr float kPostHeight = 1.8F;  ///< metres

/// A square post on the ground, a caster whose shadow is known. Metres.
[[nodiscard]] inline raster::Surface makePost(float height, float width) {
  return raster::makeDeformedBox({1, 1, 1}, 0, [=](world::Vec3 cube) {
    raster::Vertex vertex;
    vertex.position = {0.5F * width * cube.x, 0.5F * height * (cube.y + 1.0F), 0.5F * width * cube.z};
    return vertex;
  });
}

/// The opacity of the texel at a place, 0..1; 0 beyond the mask.
[[nodiscard]] inline float opacityAt(const ShadowMask& mask, world::Vec2 place) {
  const world::Vec2 texel = (place - mask.low) / (mask.high - mask.low) * world::Vec2(kShadowColumns, kShadowRows);
  if (texel.x < 0.0F || texel.y < 0.0F || texel.x >= kShadowColumns || texel.y >= kShadowRows) return 0.0F;
  const std::size_t row = static_cast<std::size_t>(texel.y);
  return static_cast<float>(mask.opacity[row * kShadowColumns + static_cast<std::size_t>(texel.x)]) / 255.0F;
}

}  // namespace grove::objects::figure
