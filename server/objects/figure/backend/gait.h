#pragma once

#include <array>

#include "raster/drawing.h"
#include "world/object.h"
#include "world/players.h"

namespace grove::objects::figure {

/// Returns the world transforms of a visitor's bones. The distance walked drives the legs, so feet do not slide; the
/// legs come to rest with the visitor.
[[nodiscard]] std::array<world::Mat4, raster::kMaxBones> bonesOf(const world::Player& player,
                                                                 const world::Transform& transform);

}  // namespace grove::objects::figure
