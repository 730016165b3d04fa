#pragma once

#include "world/geometry.h"

/// Shadows of the sun on level ground.
namespace grove::world {

/// Height above the ground at which a shadow is shown: it falls on blades of grass. Metres.
inline constexpr float kShadowPlane = 0.1F;

/// Metres from a caster beyond which no shadow is shown, however low the sun is.
inline constexpr float kLongestShadow = 14.0F;

/// Horizontal distance from a point to its shadow, for each metre of the point's height; `sun` is a unit vector towards
/// it. Very long where the sun is on the horizon or below.
[[nodiscard]] Vec3 shadowPerMetre(Vec3 sun) noexcept;

/// Encloses the shadow of everything within a box that stands on the ground.
[[nodiscard]] Bounds shadowBounds(const Bounds& caster, Vec3 sun) noexcept;

}  // namespace grove::world
