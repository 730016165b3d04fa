#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "objects/herd/frontend/shadow/affine.h"
#include "objects/herd/frontend/shadow/capsules.h"
#include "objects/herd/frontend/shadow/shadow_mask_kernels.h"

namespace grove::objects::herd {

/// The share of the sun that capsules hide: a small image in a plane perpendicular to the sun's direction. Higher
/// casters have softer edges.
class SunMask {
 public:
  static constexpr int kSide = kMaskSide;

  /// Hides nothing.
  SunMask() = default;
  /// `sun`: unit vector towards it; `ground`: a point on the ground, below the casters.
  SunMask(std::span<const Capsule> casters, world::Vec3 sun, world::Vec3 ground);

  /// A point's place in the picture.
  [[nodiscard]] const Affine& column() const noexcept { return column_; }
  [[nodiscard]] const Affine& line() const noexcept { return line_; }

  /// For a kernel: for each place, row by row, the bytes of four texels, lowest first: its own, the next in its row,
  /// and the two below. 255: hides all.
  [[nodiscard]] const std::uint32_t* texels() const noexcept { return texels_.data(); }

  /// Returns the hidden share of the sun at a place, 0..1: for points that are not between sun and casters.
  [[nodiscard]] float at(float column, float line) const noexcept;

 private:
  Affine column_;
  Affine line_;
  std::array<std::uint32_t, static_cast<std::size_t>(kSide) * kSide> texels_{};
};

}  // namespace grove::objects::herd
