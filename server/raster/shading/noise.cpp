#include "raster/shading/noise.h"

#include <array>

namespace grove::raster {
namespace {

using world::Vec3;

constexpr std::array<std::uint32_t, 3> kPrimes = {0x9E3779B1U, 0x85EBCA77U, 0xC2B2AE3DU};

float hashed(std::uint32_t h) noexcept {
  h ^= h >> 15U;
  h *= 0x2C1B3C6DU;
  return static_cast<float>(h >> 8U) * (1.0F / 16777216.0F);
}

std::uint32_t scaled(float cell, std::uint32_t prime) noexcept {
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(cell)) * prime;
}

}  // namespace

float valueNoise(Vec3 p) noexcept {
  const Vec3 cell = glm::floor(p);
  const Vec3 f = p - cell;
  const Vec3 u = f * f * (3.0F - 2.0F * f);
  const std::array<std::uint32_t, 3> low = {scaled(cell.x, kPrimes[0]), scaled(cell.y, kPrimes[1]),
                                            scaled(cell.z, kPrimes[2])};
  std::array<float, 4> plane{};
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t column = (low[0] + (i & 1U) * kPrimes[0]) ^ (low[1] + (i >> 1U) * kPrimes[1]);
    plane[i] = glm::mix(hashed(column ^ low[2]), hashed(column ^ (low[2] + kPrimes[2])), u.z);
  }
  return glm::mix(glm::mix(plane[0], plane[1], u.x), glm::mix(plane[2], plane[3], u.x), u.y);
}

float fractalNoise(Vec3 p, int octaves) noexcept {
  float sum = 0.0F;
  float strength = 1.0F;
  for (int i = 0; i < octaves; ++i) {
    sum += (valueNoise(p) - 0.5F) * strength;
    strength *= 0.5F;
    // Rotated a little, so that the octaves' lattices do not line up.
    p = Vec3(0.8F * p.x - 0.6F * p.z, p.y, 0.6F * p.x + 0.8F * p.z) * 2.03F + Vec3(17.1F, 3.7F, 29.3F);
  }
  return sum;
}

float random01(std::uint32_t seed, std::uint32_t index) noexcept {
  std::uint32_t h = seed * kPrimes[0] + index * kPrimes[1] + 0x68E31DA4U;
  h ^= h >> 16U;
  h *= 0x7FEB352DU;
  return hashed(h ^ (h >> 13U));
}

}  // namespace grove::raster
