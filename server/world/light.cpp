#include "world/light.h"

#include <algorithm>
#include <cmath>

namespace grove::world {
namespace {

const Vec3 kZenith{0.13F, 0.21F, 0.40F};
const Vec3 kHaze{0.44F, 0.385F, 0.41F};
const Vec3 kGlow{1.55F, 0.80F, 0.30F};
constexpr float kHazeMetres = 280.0F;

float sunCosine(Vec3 direction) noexcept { return std::max(0.0F, glm::dot(direction, sunDirection())); }

float power4(float x) noexcept { return x * x * (x * x); }

}  // namespace

Vec3 sunDirection() noexcept {
  static const Vec3 direction = glm::normalize(Vec3(-0.46F, 0.185F, -0.87F));
  return direction;
}

Vec3 sunColour() noexcept { return {1.90F, 1.12F, 0.54F}; }

Vec3 skyRadiance(Vec3 direction) noexcept {
  const float height = std::max(0.0F, direction.y);
  const float cosine = sunCosine(direction);
  const Vec3 low = hazeColour(direction);
  const Vec3 colour = glm::mix(low, kZenith, 1.0F - std::exp(-3.4F * height));
  const float towardsSun = power4(power4(power4(cosine)));
  return colour + kGlow * (0.35F * towardsSun * (1.0F - std::exp(-20.0F * height)));
}

Vec3 ambient(Vec3 normal) noexcept {
  const float up = 0.5F + 0.5F * normal.y;
  const float towardsSun = 0.5F + 0.5F * glm::dot(normal, glm::normalize(Vec3(sunDirection().x, 0, sunDirection().z)));
  const Vec3 sky{0.25F, 0.32F, 0.46F};
  const Vec3 ground{0.13F, 0.10F, 0.06F};
  const Vec3 glow{0.24F, 0.15F, 0.07F};
  return glm::mix(ground, sky, up) + glow * towardsSun * towardsSun;
}

Vec3 hazeColour(Vec3 direction) noexcept {
  const float c4 = power4(sunCosine(direction));
  return kHaze + kGlow * (0.36F * c4 + 0.30F * power4(c4));
}

float hazeAmount(float distance) noexcept { return 1.0F - std::exp(-distance / kHazeMetres); }

float toDisplay(float linear) noexcept {
  const float x = std::max(0.0F, linear) * 0.85F;
  const float mapped = std::clamp((x * (2.51F * x + 0.03F)) / (x * (2.43F * x + 0.59F) + 0.14F), 0.0F, 1.0F);
  return mapped <= 0.0031308F ? 12.92F * mapped : 1.055F * std::pow(mapped, 1.0F / 2.4F) - 0.055F;
}

std::uint32_t toDisplayRgba(Vec3 linear) noexcept {
  const auto byte = [](float value) { return static_cast<std::uint32_t>(std::lround(toDisplay(value) * 255.0F)); };
  return byte(linear.r) | byte(linear.g) << 8U | byte(linear.b) << 16U | 0xFF000000U;
}

}  // namespace grove::world
