#include "world/light.h"

#include <algorithm>
#include <cmath>

namespace grove::world {
namespace {

constexpr float kHazeMetres = 280.0F;

}  // namespace

float hazeAmount(float distance) noexcept { return 1.0F - std::exp(-distance / kHazeMetres); }

float mistAmount(float distance) noexcept {
  return kMostMist * glm::smoothstep(kMistBegins, kMistIsThickest, distance);
}

float toDisplay(float linear) noexcept {
  const float x = std::max(0.0F, linear) * 0.7F;
  const float mapped = std::clamp((x * (2.51F * x + 0.14F)) / (x * (2.43F * x + 0.59F) + 0.14F), 0.0F, 1.0F);
  return mapped <= 0.0031308F ? 12.92F * mapped : 1.055F * std::pow(mapped, 1.0F / 2.4F) - 0.055F;
}

std::uint32_t toDisplayRgba(Vec3 linear) noexcept {
  const auto byte = [](float value) { return static_cast<std::uint32_t>(std::lround(toDisplay(value) * 255.0F)); };
  return byte(linear.r) | byte(linear.g) << 8U | byte(linear.b) << 16U | 0xFF000000U;
}

}  // namespace grove::world
