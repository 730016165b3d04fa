#pragma once

#include "models/model.h"

namespace grove::bake {

/// The longest edge that a triangle may have, metres.
struct LongestEdge {
  float solid = 0.1F;   ///< of solid materials
  float leaves = 0.3F;  ///< of others: shadows on what is small and thin cannot be distinguished
};

/// The same surface as a model whose edges are no longer than wanted, so that light that is kept at vertices can follow
/// shadows; triangles with two sides are ordered so that they wind counter-clockwise around their vertices' normals.
[[nodiscard]] models::Model refined(models::Model model, const LongestEdge& longest);

}  // namespace grove::bake
