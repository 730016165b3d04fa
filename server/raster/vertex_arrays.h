#pragma once

#include <cstdint>
#include <vector>

#include "raster/drawing.h"

namespace grove::raster {

/// The vertices of a lit surface in the layout for vectorised loops: one array per member.
struct VertexArrays {
  /// Adjacent vertices that follow the same bone.
  struct Run {
    std::size_t begin;
    std::size_t end;
    std::size_t bone;
  };

  explicit VertexArrays(const LitSurface& object);

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept {
    return pipeline::vectorBytes(runs, positionX, positionY, positionZ, normalX, normalY, normalZ, albedoR, albedoG,
                                 albedoB, emission, tint, lichen, sun, indirectR, indirectG, indirectB);
  }

  std::vector<Run> runs;
  std::vector<float> positionX, positionY, positionZ;
  std::vector<float> normalX, normalY, normalZ;
  std::vector<float> albedoR, albedoG, albedoB;
  std::vector<float> emission;
  std::vector<float> tint;
  std::vector<float> lichen;
  std::vector<float> sun;                              // LitSurface::light.x
  std::vector<float> indirectR, indirectG, indirectB;  // and yzw
};

}  // namespace grove::raster
