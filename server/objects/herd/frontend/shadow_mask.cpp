#include "objects/herd/frontend/shadow_mask.h"

#include <algorithm>
#include <cmath>

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
  scale_ = (static_cast<float>(kSide) - 2.0F * kMargin) / std::max({high.x - low.x, high.y - low.y, 0.1F});
  column_ = {scale_ * across, kMargin - scale_ * low.x};
  line_ = {scale_ * upward, kMargin - scale_ * low.y};
  for (const Capsule& each : casters) {
    const float height = std::max(0.0F, 0.5F * (each.from.y + each.to.y) - ground.y);
    this->add(each, kSoftness * height / std::max(sun.y, kLowestSun));
  }
}

void SunMask::add(const Capsule& caster, float softMetres) {
  const Vec2 from = placeOf(caster.from);
  const Vec2 way = placeOf(caster.to) - from;
  const float square = std::max(glm::dot(way, way), 1.0e-6F);
  const float soft = std::max(kLeastSoft, softMetres * scale_);
  const float fromRadius = caster.fromRadius * scale_;
  const float toRadius = caster.toRadius * scale_;
  const float margin = std::max(fromRadius, toRadius) + soft;
  const auto texel = [](float value) { return std::clamp(static_cast<int>(std::floor(value)), 0, kSide - 1); };
  const int bottom = texel(std::max(from.y, from.y + way.y) + margin);
  const int right = texel(std::max(from.x, from.x + way.x) + margin);
  for (int y = texel(std::min(from.y, from.y + way.y) - margin); y <= bottom; ++y) {
    for (int x = texel(std::min(from.x, from.x + way.x) - margin); x <= right; ++x) {
      const Vec2 off = Vec2(static_cast<float>(x), static_cast<float>(y)) - from;
      const float share = std::clamp(glm::dot(off, way) / square, 0.0F, 1.0F);
      const float inside = glm::mix(fromRadius, toRadius, share) - glm::length(off - share * way);
      const float cover = std::clamp(0.5F + 0.5F * inside / soft, 0.0F, 1.0F);
      std::uint8_t& out = texels_[static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x)];
      out = std::max(out, static_cast<std::uint8_t>(cover * 255.0F));
    }
  }
}

}  // namespace grove::objects::herd
