#pragma once

#include <cstddef>
#include <cstdint>

#include "raster/simd/projection.h"
#include "raster/simd/rasteriser.h"

namespace grove::raster {

/// Points, one array per coordinate.
struct Points {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  std::size_t count = 0;
};

/// Bounds of many projected points. Pixels are valid only if all points are in front of the eye.
struct Extent {
  float left;
  float right;
  float top;
  float bottom;
  float nearest;  ///< least depth
};

/// For at least one point; pixels are accurate to a thousandth.
[[nodiscard]] Extent extentOf(const Points& points, const Projection& projection);

/// Writes the points' pixels times depth, and depths; returns the least depth, or kInfiniteDepth if there is none.
[[nodiscard]] float transform(const Points& points, const Projection& projection, float* u, float* v, float* depth);

/// Makes corners from the vertices of transform(), the light of lightVertices() and lichen 0..1.
void makeCorners(const float* u, const float* v, const float* depth, const std::uint32_t* light, const float* lichen,
                 std::size_t count, float nearDepth, Corner* corners);

}  // namespace grove::raster
