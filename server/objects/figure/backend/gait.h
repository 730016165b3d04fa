#pragma once

#include <array>

#include "raster/drawing.h"
#include "world/object.h"
#include "world/players.h"

namespace grove::objects::figure {

/// Where each bone of a walking visitor is, in the world. The legs swing by the way walked, so feet do not slide, and
/// come to rest with the visitor.
[[nodiscard]] std::array<world::Mat4, raster::kMaxBones> bonesOf(const world::Player& player,
                                                                 const world::Transform& transform);

}  // namespace grove::objects::figure
