#pragma once

#include "world/geometry.h"

/// Deterministic noise on integer hashes, equal on every machine and to shaders/common/noise.glsl.
namespace grove::objects::mesh {

struct NoiseSample {
  float value = 0.0F;  ///< 0..1
  world::Vec3 gradient{0.0F};
};

/// Trilinear value noise with smooth cells of size one, and its analytic gradient.
[[nodiscard]] NoiseSample valueNoise(world::Vec3 p) noexcept;

/// Octaves of value noise around zero, each twice as fine and half as strong; within -1..1.
[[nodiscard]] float fractalNoise(world::Vec3 p, int octaves) noexcept;

/// A random number in 0..1 for a seed and an index.
[[nodiscard]] float random01(std::uint32_t seed, std::uint32_t index) noexcept;

}  // namespace grove::objects::mesh
