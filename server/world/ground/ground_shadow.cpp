#include "world/ground/ground_shadow.h"

#include <algorithm>

namespace grove::world {
namespace {

/// Of the sun's height: a lower sun counts as this one.
constexpr float kLowestSun = 0.01F;

}  // namespace

Vec3 shadowPerMetre(Vec3 sun) noexcept { return Vec3(-sun.x, 0.0F, -sun.z) / std::max(sun.y, kLowestSun); }

Bounds shadowBounds(const Bounds& caster, Vec3 sun) noexcept {
  const Vec3 whole = shadowPerMetre(sun) * caster.size().y;
  const Vec3 reach = whole * (kLongestShadow / std::max(glm::length(whole), kLongestShadow));
  const Bounds foot{caster.low, {caster.high.x, caster.low.y + kShadowPlane, caster.high.z}};
  Bounds bounds = foot;
  bounds.add({foot.low + reach, foot.high + reach});
  return bounds;
}

}  // namespace grove::world
