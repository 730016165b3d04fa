#pragma once

#include "models/model.h"
#include "raster/surface.h"

namespace grove::objects::mesh {

/// Converts a plant or an imported model to a surface of one level. Double-sided parts get two sides; textures become
/// vertex colours; withHolesCut() has cut the holes before.
[[nodiscard]] raster::Surface surfaceOf(const models::Model& model);

/// The part that blocks smoke; empty if there is none.
[[nodiscard]] world::Triangles solidOf(const models::Model& model);

}  // namespace grove::objects::mesh
