#pragma once

#include "models/model.h"
#include "raster/surface.h"

namespace grove::objects::mesh {

/// A plant or an imported model as a surface of one level. What is seen from both sides gets two sides; textures colour
/// its vertices; holes have been cut out before (withHolesCut()).
[[nodiscard]] raster::Surface surfaceOf(const models::Model& model);

/// The part that keeps smoke out; empty if it has none.
[[nodiscard]] world::Triangles solidOf(const models::Model& model);

}  // namespace grove::objects::mesh
