#pragma once

#include <cstddef>
#include <span>

#include "raster/outline/surface_edges.h"
#include "raster/simd/cut_triangles.h"
#include "raster/simd/rasteriser.h"

namespace grove::raster {

/// The lit triangles of a drawing on the screen, without what is nearer than the near depth. Reused across drawings, so
/// that none allocates.
class ScreenSurface {
 public:
  /// `arrays` are those of the drawing's object, and outlive the next call.
  void make(const Drawing& drawing, const VertexArrays& arrays);

  [[nodiscard]] std::span<const Triangle> triangles() const noexcept { return triangles_; }
  [[nodiscard]] std::span<const Corner> corners() const noexcept { return corners_; }
  /// Their edges; empty if the triangles share no corners, because some were clipped.
  [[nodiscard]] std::span<const SurfaceEdge> edges() const noexcept { return edges_; }

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept {
    return vertices_.bytes() + pipeline::vectorBytes(cut_.corners, cut_.triangles);
  }

 private:
  ScreenVertices vertices_;
  CutTriangles cut_;
  std::span<const Triangle> triangles_;
  std::span<const Corner> corners_;
  std::span<const SurfaceEdge> edges_;
};

}  // namespace grove::raster
