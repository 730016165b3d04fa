#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/surface.h"

namespace grove::raster {

/// An edge of one or two triangles.
struct SurfaceEdge {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  std::uint32_t from = 0;  ///< vertices, in the order of the triangle to the left
  std::uint32_t to = 0;
  std::uint32_t left = 0;       ///< triangle
  std::uint32_t right = kNone;  ///< the other triangle of the edge
};

/// Finds the edges of triangles that share vertices. An edge of more than two triangles is several edges.
[[nodiscard]] std::vector<SurfaceEdge> edgesOf(std::span<const Triangle> triangles);

}  // namespace grove::raster
