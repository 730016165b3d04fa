#pragma once

#include "objects/fluid/backend/solver/grid.h"

namespace grove::objects::fluid {

/// Fills the ghosts: what lies outside of a cell or face at the border equals it; a velocity across a closed side is 0.
void fillVelocityGhosts(const Layout& layout, const Sides& sides, Velocity& velocity);

/// Ghosts of a field of cell centres: outside of open sides there is fresh air (0), at walls the nearest value.
void fillCentreGhosts(const Layout& layout, const Sides& sides, Field& field);

}  // namespace grove::objects::fluid
