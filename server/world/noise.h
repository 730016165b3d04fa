#pragma once

#include <cmath>
#include <cstdint>

#include "world/geometry.h"

/// Deterministic noise for baked pictures of nature.
namespace grove::world {

/// Scrambles an integer (C. Wellons, "Prospecting for Hash Functions", lowbias32).
[[nodiscard]] inline std::uint32_t hash(std::uint32_t x) noexcept {
  x = (x ^ (x >> 16U)) * 0x7FEB352DU;
  x = (x ^ (x >> 15U)) * 0x846CA68BU;
  return x ^ (x >> 16U);
}

/// 0..1 for a point of an integer lattice.
[[nodiscard]] inline float hashUnit(std::int32_t x, std::int32_t y, std::int32_t z = 0) noexcept {
  const std::uint32_t key = static_cast<std::uint32_t>(x) * 0x8DA6B343U ^ static_cast<std::uint32_t>(y) * 0xD8163841U ^
                            static_cast<std::uint32_t>(z) * 0xCB1AB31FU;
  return static_cast<float>(hash(key) >> 8U) * (1.0F / 16777216.0F);
}

/// Between four points of a lattice's plane `z`, by a smooth share of the way to the next ones.
[[nodiscard]] inline float noiseInPlane(std::int32_t x, std::int32_t y, std::int32_t z, Vec2 share) noexcept {
  const float top = glm::mix(hashUnit(x, y, z), hashUnit(x + 1, y, z), share.x);
  const float bottom = glm::mix(hashUnit(x, y + 1, z), hashUnit(x + 1, y + 1, z), share.x);
  return glm::mix(top, bottom, share.y);
}

/// Value noise in 0..1 with features of about one unit.
[[nodiscard]] inline float noise(Vec3 p) noexcept {
  const Vec3 floor = glm::floor(p);
  const Vec3 f = p - floor;
  const Vec3 s = f * f * (3.0F - 2.0F * f);
  const auto x = static_cast<std::int32_t>(floor.x);
  const auto y = static_cast<std::int32_t>(floor.y);
  const auto z = static_cast<std::int32_t>(floor.z);
  return glm::mix(noiseInPlane(x, y, z, s), noiseInPlane(x, y, z + 1, s), s.z);
}

/// The same in the plane.
[[nodiscard]] inline float noise(Vec2 p) noexcept {
  const Vec2 floor = glm::floor(p);
  const Vec2 f = p - floor;
  return noiseInPlane(static_cast<std::int32_t>(floor.x), static_cast<std::int32_t>(floor.y), 0,
                      f * f * (3.0F - 2.0F * f));
}

/// Fractal sum of `octaves` noises in 0..1, each twice as fine and half as strong as the previous one.
template <class Point>
[[nodiscard]] float fractalNoise(Point p, int octaves) noexcept {
  float sum = 0.0F;
  float weight = 0.5F;
  float total = 0.0F;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * noise(p);
    total += weight;
    weight *= 0.5F;
    p = p * 2.03F + 17.3F;
  }
  return sum / total;
}

}  // namespace grove::world
