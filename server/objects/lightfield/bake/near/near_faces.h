#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "models/model.h"

namespace grove::bake {

/// One or two triangles of a model.
struct ModelFace {
  /// Vertices, counter-clockwise seen from the front. The last two of a triangle are the same.
  std::array<std::uint32_t, 4> corners{};
  std::uint16_t material = 0;

  [[nodiscard]] bool isTriangle() const noexcept { return corners[2] == corners[3]; }
};

/// The triangles of a model. Two that follow each other and make an almost flat, convex quadrilateral are one face.
[[nodiscard]] std::vector<ModelFace> facesOf(const models::Model& model);

}  // namespace grove::bake
