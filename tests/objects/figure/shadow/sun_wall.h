#pragma once

#include "world/geometry.h"

namespace grove::objects::figure {

/// For places behind sunWall(), at +Z of it.
inline const world::Vec3 kSunOfWall = glm::normalize(world::Vec3(0.0F, 0.5F, -1.0F));

/// A wall along the X axis, from far away at -X to `end`. Metres.
[[nodiscard]] inline world::Triangles sunWall(float end, float height = 20.0F) {
  world::Triangles wall;
  wall.positions = {{-50, 0, 0}, {end, 0, 0}, {end, height, 0}, {-50, height, 0}};
  wall.indices = {{0, 1, 2}, {0, 2, 3}};
  return wall;
}

}  // namespace grove::objects::figure
