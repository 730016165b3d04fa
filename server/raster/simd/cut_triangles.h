#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/simd/rasteriser.h"
#include "raster/surface.h"

namespace grove::raster {

/// Triangles with unshared corners, three consecutive ones each.
struct CutTriangles {
  std::vector<Corner> corners;
  std::vector<Triangle> triangles;

  void clear() {
    corners.clear();
    triangles.clear();
  }
  void add(const std::array<Corner, 3>& triangle) {
    const auto first = static_cast<std::uint32_t>(corners.size());
    corners.insert(corners.end(), triangle.begin(), triangle.end());
    triangles.push_back({first, first + 1, first + 2});
  }
};

/// Clips the parts nearer than the near depth.
void cut(std::span<const Triangle> triangles, const ScreenVertices& vertices, const std::vector<float>& lichen,
         float nearDepth, CutTriangles& out);

}  // namespace grove::raster
