#pragma once

#include <cstddef>
#include <span>

#include "world/geometry.h"

namespace grove::world {

/// A smooth hill on the plane y = 0. At distance d from its centre it is `height * (1 - (d / radius)^2)^2` high, and 0
/// beyond its radius.
struct Hill {
  Vec2 centre{0.0F};  ///< x and z
  float radius = 1.0F;
  float height = 0.0F;
};

/// Hills stay below visitors' eyes, so that none rises above the horizon of the plane.
inline constexpr float kMaxGroundHeight = 1.6F;

/// Of a scene. Every height is a sum over all of them.
inline constexpr std::size_t kMaxHills = 64;

/// Height of the ground at a place (x and z), metres: the sum of the hills there.
[[nodiscard]] float groundHeight(std::span<const Hill> hills, Vec2 place) noexcept;

/// Gradient of the height, along x and z.
[[nodiscard]] Vec2 groundSlope(std::span<const Hill> hills, Vec2 place) noexcept;

}  // namespace grove::world
