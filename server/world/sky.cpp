#include "world/sky.h"

#include <algorithm>
#include <cmath>

namespace grove::world {
namespace {

float cosineBetween(Vec3 a, Vec3 b) noexcept { return std::max(0.0F, glm::dot(a, b)); }

float power4(float x) noexcept { return x * x * (x * x); }

}  // namespace

Vec3 Sky::radiance(Vec3 direction) const noexcept {
  const float height = std::max(0.0F, direction.y);
  const Vec3 colour = glm::mix(hazeColour(direction), zenith, 1.0F - std::exp(-3.4F * height));
  const float towardsSun = power4(power4(power4(cosineBetween(direction, sun))));
  return colour + glow * (0.35F * towardsSun * (1.0F - std::exp(-20.0F * height)));
}

Vec3 Sky::ambient(Vec3 normal) const noexcept {
  const float up = 0.5F + 0.5F * normal.y;
  const float towardsSun = 0.5F + 0.5F * glm::dot(normal, glm::normalize(Vec3(sun.x, 0, sun.z)));
  return glm::mix(ambientGround, ambientSky, up) + ambientGlow * towardsSun * towardsSun;
}

Vec3 Sky::hazeColour(Vec3 direction) const noexcept {
  const float c4 = power4(cosineBetween(direction, sun));
  return haze + glow * (0.36F * c4 + 0.30F * power4(c4));
}

}  // namespace grove::world
