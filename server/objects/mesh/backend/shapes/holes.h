#pragma once

#include "models/model.h"

namespace grove::objects::mesh {

/// Triangles that cutting may add to a model, or thereabouts: half of what an oak has.
inline constexpr std::size_t kMaxPieces = 60'000;

/// The model without what its textures make transparent, as a light field shows it: a triangle with holes becomes
/// pieces of a few texels, and those without enough to see are left out.
///
/// What cannot be shown is named in the log: materials that blend (what is left of them is solid) and those with more
/// triangles than can be cut.
[[nodiscard]] models::Model withHolesCut(models::Model model);

}  // namespace grove::objects::mesh
