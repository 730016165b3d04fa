#pragma once

#include <cstddef>
#include <cstdint>

#include "raster/simd/projection.h"
#include "raster/simd/rasteriser.h"

namespace grove::raster {

/// Points, an array for each coordinate.
struct Points {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  std::size_t count = 0;
};

/// Of many points on the screen. Pixels mean something only if all points are before the eye.
struct Extent {
  float left;
  float right;
  float top;
  float bottom;
  float nearest;  ///< lowest depth
};

/// Of at least one point; pixels to a thousandth.
[[nodiscard]] Extent extentOf(const Points& points, const Projection& projection);

/// Writes the points' pixels times depth, and depths; returns the lowest depth, or kInfiniteDepth if there is none.
[[nodiscard]] float transform(const Points& points, const Projection& projection, float* u, float* v, float* depth);

/// Makes corners of vertices as transform() gives them, with light as of lightVertices() and lichen 0..1.
void makeCorners(const float* u, const float* v, const float* depth, const std::uint32_t* light, const float* lichen,
                 std::size_t count, float nearDepth, Corner* corners);

}  // namespace grove::raster
