#pragma once

#include <array>

#include "world/sky.h"

namespace grove::objects::sky {

/// Hills and lines of trees around the clearing, too far to move when a visitor walks.
inline constexpr int kRidges = 6;

/// How high each ridge stands at one heading, far to near: tangents of elevation.
struct Skyline {
  std::array<float, kRidges> tops{};
};

[[nodiscard]] Skyline skylineAt(float heading, float seed);

/// Radiance of the landscape in front of `behind`. `direction` is a unit vector whose elevation has the tangent
/// `tangent`; edges are as soft as `texel`, the tangents' step between texels.
[[nodiscard]] world::Vec3 landscapeOver(const world::Sky& sky, world::Vec3 behind, const Skyline& skyline,
                                        world::Vec3 direction, float heading, float tangent, float texel, float seed);

}  // namespace grove::objects::sky
