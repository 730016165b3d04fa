#pragma once

#include <array>

#include "world/sky.h"

namespace grove::objects::sky {

/// Hills and lines of trees around the clearing, too distant for visible parallax.
inline constexpr int kRidges = 6;

/// Heights at one heading: tangents of elevation.
struct Skyline {
  std::array<float, kRidges> tops{};  ///< of each ridge, farthest first
  float mistTop = 0.0F;               ///< of the meadow's mist, which is ragged there
};

[[nodiscard]] Skyline skylineAt(float heading, float seed);

/// Radiance of the landscape in front of `behind`. `direction` is a unit vector with tangent of elevation `tangent`;
/// edges are as soft as `texel`, the tangent's step between texels.
[[nodiscard]] world::Vec3 landscapeOver(const world::Sky& sky, world::Vec3 behind, const Skyline& skyline,
                                        world::Vec3 direction, float heading, float tangent, float texel, float seed);

}  // namespace grove::objects::sky
