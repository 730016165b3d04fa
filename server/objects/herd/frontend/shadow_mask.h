#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "objects/herd/frontend/affine.h"
#include "objects/herd/frontend/capsules.h"

namespace grove::objects::herd {

/// How much of the sun thick lines hide, seen along its rays: a small picture in a plane across them. Its edges are
/// softer, the higher the caster is above the ground.
class SunMask {
 public:
  static constexpr int kSide = 48;

  /// Hides nothing.
  SunMask() = default;
  /// `sun`: unit vector towards it; `ground`: a point on the ground, below the casters.
  SunMask(std::span<const Capsule> casters, world::Vec3 sun, world::Vec3 ground);

  /// A point's place in the picture.
  [[nodiscard]] const Affine& column() const noexcept { return column_; }
  [[nodiscard]] const Affine& line() const noexcept { return line_; }

  /// Returns the hidden share of the sun at a place, 0..1: for points that are not between sun and casters.
  [[nodiscard]] float at(float column, float line) const noexcept;

 private:
  void add(const Capsule& caster, float softMetres);
  [[nodiscard]] world::Vec2 placeOf(world::Vec3 point) const noexcept { return {column_.at(point), line_.at(point)}; }

  Affine column_;
  Affine line_;
  float scale_ = 1.0F;  ///< texels per metre
  std::array<std::uint8_t, static_cast<std::size_t>(kSide) * kSide> texels_{};
};

inline float SunMask::at(float column, float line) const noexcept {
  constexpr auto kLast = static_cast<float>(kSide - 1);
  if (!(column >= 0.0F && line >= 0.0F && column < kLast && line < kLast)) return 0.0F;
  const auto x = static_cast<int>(column);
  const auto y = static_cast<int>(line);
  const std::uint8_t* const texel = texels_.data() + (y * kSide + x);
  if ((texel[0] | texel[1] | texel[kSide] | texel[kSide + 1]) == 0) return 0.0F;
  const float right = column - static_cast<float>(x);
  const float down = line - static_cast<float>(y);
  const auto cover = [&](int of) { return static_cast<float>(texel[of]); };
  const float above = glm::mix(cover(0), cover(1), right);
  const float below = glm::mix(cover(kSide), cover(kSide + 1), right);
  return glm::mix(above, below, down) * (1.0F / 255.0F);
}

}  // namespace grove::objects::herd
