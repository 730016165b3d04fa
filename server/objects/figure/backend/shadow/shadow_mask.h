#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "objects/figure/backend/shadow/shadow_caster.h"
#include "pipeline/vector_bytes.h"
#include "world/geometry.h"

namespace grove::objects::figure {

/// The ground as the sun sees it around a figure at the origin. A place has two coordinates in metres: across the sun's
/// direction, and the height of the point above the figure's feet whose shadow falls there.
struct SunView {
  /// `sun` is a unit vector towards it.
  explicit SunView(world::Vec3 sun) noexcept;

  [[nodiscard]] world::Vec2 of(world::Vec3 point) const noexcept {
    return {glm::dot(point, side), glm::dot(point, away) * slope + point.y};
  }

  world::Vec3 away;  ///< unit vector away from the sun, level
  world::Vec3 side;  ///< unit vector, level
  float slope;       ///< tangent of the sun's elevation
};

/// A figure's shadow in a SunView: the softer, the higher above the ground is what casts it.
struct ShadowMask {
  world::Vec2 low{0.0F};              ///< where the mask begins
  world::Vec2 high{0.0F};             ///< where it ends; there is no shadow at its ends and beyond
  std::vector<std::uint8_t> opacity;  ///< kShadowRows rows of kShadowColumns, upwards; 255: no sun

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept { return sizeof *this + pipeline::vectorBytes(opacity); }
};

/// `bones` place the figure, whose feet are at the origin.
[[nodiscard]] ShadowMask castShadow(const ShadowCaster& caster, std::span<const world::Mat4> bones, const SunView& sun);

}  // namespace grove::objects::figure
