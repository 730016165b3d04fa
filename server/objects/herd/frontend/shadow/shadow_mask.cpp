#include "objects/herd/frontend/shadow/shadow_mask.h"

#include <algorithm>

namespace grove::objects::herd {
namespace {

using world::Vec2;
using world::Vec3;

/// Texels around the casters for soft edges.
constexpr float kMargin = 3.0F;
/// Half the width of a shadow's soft edge for each metre that it is away from its caster.
constexpr float kSoftness = 0.012F;
constexpr float kLowestSun = 0.05F;
constexpr float kLeastSoft = 0.6F;  // texels

}  // namespace

SunMask::SunMask(std::span<const Capsule> casters, Vec3 sun, Vec3 ground) {
  const Vec3 across = glm::normalize(Vec3(-sun.z, 0.0F, sun.x) + Vec3(1.0e-6F, 0.0F, 0.0F));
  const Vec3 upward = glm::cross(sun, across);
  Vec2 low(1.0e9F);
  Vec2 high(-1.0e9F);
  const auto add = [&](Vec3 point, float radius) {
    const Vec2 flat(glm::dot(point, across), glm::dot(point, upward));
    low = glm::min(low, flat - radius);
    high = glm::max(high, flat + radius);
  };
  for (const Capsule& each : casters) {
    add(each.from, each.fromRadius);
    add(each.to, each.toRadius);
  }
  const float scale = (static_cast<float>(kSide) - 2.0F * kMargin) / std::max({high.x - low.x, high.y - low.y, 0.1F});
  column_ = {scale * across, kMargin - scale * low.x};
  line_ = {scale * upward, kMargin - scale * low.y};
  const auto placeOf = [&](Vec3 point) { return Vec2(column_.at(point), line_.at(point)); };
  std::array<float, kMaskFloats> cover{};
  for (const Capsule& each : casters) {
    const float height = std::max(0.0F, 0.5F * (each.from.y + each.to.y) - ground.y);
    const Vec2 from = placeOf(each.from);
    const float soft = kSoftness * height / std::max(sun.y, kLowestSun);
    coverCapsule({from, placeOf(each.to) - from, scale * each.fromRadius, scale * each.toRadius,
                  std::max(kLeastSoft, scale * soft)},
                 cover.data());
  }
  packFours(cover.data(), texels_.data());
}

float SunMask::at(float column, float line) const noexcept {
  constexpr auto kLast = static_cast<float>(kSide - 1);
  if (!(column >= 0.0F && line >= 0.0F && column < kLast && line < kLast)) return 0.0F;
  const auto x = static_cast<int>(column);
  const auto y = static_cast<int>(line);
  const std::uint32_t four = texels_[static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x)];
  const auto cover = [&](unsigned of) { return static_cast<float>(four >> 8U * of & 0xFFU); };
  const float right = column - static_cast<float>(x);
  const float above = glm::mix(cover(0), cover(1), right);
  const float below = glm::mix(cover(2), cover(3), right);
  return glm::mix(above, below, line - static_cast<float>(y)) * (1.0F / 255.0F);
}

}  // namespace grove::objects::herd
