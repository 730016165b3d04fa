#pragma once

#include <cstdint>
#include <vector>

#include "raster/drawing.h"
#include "raster/outline/surface_edges.h"

namespace grove::raster {

/// The vertices of a lit surface in the layout for vectorised loops: one array per member; and its edges.
struct VertexArrays {
  /// Adjacent vertices that follow the same bone.
  struct Run {
    std::size_t begin;
    std::size_t end;
    std::size_t bone;
  };

  explicit VertexArrays(const LitSurface& object);

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept;

  std::vector<Run> runs;
  std::size_t bones = 0;  ///< all runs have smaller bones; at most kMaxBones
  std::vector<float> positionX, positionY, positionZ;
  std::vector<float> normalX, normalY, normalZ;
  std::vector<float> albedoR, albedoG, albedoB;
  std::vector<float> emission;
  std::vector<float> tint;
  std::vector<float> lichen;
  std::vector<float> sun;                              // LitSurface::light.x
  std::vector<float> indirectR, indirectG, indirectB;  // and yzw
  std::vector<std::vector<SurfaceEdge>> edges;         // by level
};

}  // namespace grove::raster
