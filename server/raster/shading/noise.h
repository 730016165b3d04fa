#pragma once

#include "world/geometry.h"

/// Deterministic noise on integer hashes, equal on every machine. Like world/noise.h, but its hash is twice as fast,
/// for surfaces of millions of vertices. The other noise would change the stones' shapes.
namespace grove::raster {

/// Trilinear value noise in 0..1 with smooth cells of size one.
[[nodiscard]] float valueNoise(world::Vec3 p) noexcept;

/// Octaves of value noise around zero, each twice as fine and half as strong; within -1..1.
[[nodiscard]] float fractalNoise(world::Vec3 p, int octaves) noexcept;

/// A random number in 0..1 for a seed and an index.
[[nodiscard]] float random01(std::uint32_t seed, std::uint32_t index) noexcept;

}  // namespace grove::raster
