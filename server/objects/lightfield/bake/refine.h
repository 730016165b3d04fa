#pragma once

#include "models/model.h"

namespace grove::bake {

/// Largest permitted edge of a triangle, metres.
struct LongestEdge {
  float solid = 0.1F;   ///< of solid materials
  float leaves = 0.3F;  ///< of others: shadows on small and thin parts cannot be distinguished
};

/// Returns the same surface with edges no longer than `longest`, so that light at vertices can follow shadows.
/// Triangles with two sides wind counter-clockwise around their vertices' normals.
[[nodiscard]] models::Model refined(models::Model model, const LongestEdge& longest);

}  // namespace grove::bake
