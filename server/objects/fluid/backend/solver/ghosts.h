#pragma once

#include "objects/fluid/backend/solver/grid.h"

namespace grove::objects::fluid {

/// Fills the ghosts: each equals the nearest cell or face at the border; a velocity across a closed side is 0.
void fillVelocityGhosts(const Layout& layout, const Sides& sides, Velocity& velocity);

/// Fills the ghosts of a field at cell centres: fresh air (0) outside open sides, the nearest value at walls.
void fillCentreGhosts(const Layout& layout, const Sides& sides, Field& field);

}  // namespace grove::objects::fluid
