#pragma once

#include <array>
#include <span>

#include "raster/simd/rasteriser.h"

namespace grove::raster {

/// The part of a triangle beyond a depth: a polygon with three, four or no corners.
class NearClip {
 public:
  NearClip(const std::array<ClipVertex, 3>& triangle, float nearDepth) noexcept;

  /// In the triangle's order.
  [[nodiscard]] std::span<const ClipVertex> polygon() const noexcept { return std::span(corners_).first(count_); }

 private:
  std::array<ClipVertex, 4> corners_;
  std::size_t count_ = 0;
};

}  // namespace grove::raster
