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

/// Value noise in 0..1 with features of about one unit.
[[nodiscard]] inline float noise(Vec3 p) noexcept {
  const Vec3 floor = glm::floor(p);
  const Vec3 f = p - floor;
  const Vec3 s = f * f * (3.0F - 2.0F * f);
  const auto x = static_cast<std::int32_t>(floor.x);
  const auto y = static_cast<std::int32_t>(floor.y);
  const auto z = static_cast<std::int32_t>(floor.z);
  const auto plane = [&](std::int32_t at) {
    const float top = glm::mix(hashUnit(x, y, at), hashUnit(x + 1, y, at), s.x);
    const float bottom = glm::mix(hashUnit(x, y + 1, at), hashUnit(x + 1, y + 1, at), s.x);
    return glm::mix(top, bottom, s.y);
  };
  return glm::mix(plane(z), plane(z + 1), s.z);
}

/// The same in the plane.
[[nodiscard]] inline float noise(Vec2 p) noexcept {
  const Vec2 floor = glm::floor(p);
  const Vec2 f = p - floor;
  const Vec2 s = f * f * (3.0F - 2.0F * f);
  const auto x = static_cast<std::int32_t>(floor.x);
  const auto y = static_cast<std::int32_t>(floor.y);
  const float top = glm::mix(hashUnit(x, y), hashUnit(x + 1, y), s.x);
  const float bottom = glm::mix(hashUnit(x, y + 1), hashUnit(x + 1, y + 1), s.x);
  return glm::mix(top, bottom, s.y);
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
