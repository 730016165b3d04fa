#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "pipeline/vector_bytes.h"
#include "raster/outline/surface_edges.h"
#include "raster/surface.h"

namespace grove::objects::figure {

/// What of a figure casts its shadow. Across-user: made once for all poses.
class ShadowCaster {
 public:
  /// `figure` outlives this.
  explicit ShadowCaster(const raster::Surface& figure);

  /// The corners of the triangles, and perhaps others.
  [[nodiscard]] std::span<const raster::Vertex> vertices() const noexcept { return vertices_; }
  [[nodiscard]] std::span<const raster::Triangle> triangles() const noexcept { return triangles_; }
  [[nodiscard]] std::span<const raster::SurfaceEdge> edges() const noexcept { return edges_; }

  /// Memory use, without the figure.
  [[nodiscard]] std::size_t bytes() const noexcept { return pipeline::vectorBytes(edges_); }

 private:
  std::span<const raster::Vertex> vertices_;
  std::span<const raster::Triangle> triangles_;
  std::vector<raster::SurfaceEdge> edges_;
};

}  // namespace grove::objects::figure
