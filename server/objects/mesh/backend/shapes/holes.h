#pragma once

#include "models/model.h"

namespace grove::objects::mesh {

/// Approximate limit of the triangles that cutting adds to a model: half as many as an oak has.
inline constexpr std::size_t kMaxPieces = 60'000;

/// Returns the model without its transparent parts, as a light field shows it: a triangle with holes becomes pieces of
/// a few texels, and mostly transparent pieces are dropped.
///
/// Logs the limits: materials that blend (their remaining pieces are opaque) and materials with too many triangles to
/// cut.
[[nodiscard]] models::Model withHolesCut(models::Model model);

}  // namespace grove::objects::mesh
