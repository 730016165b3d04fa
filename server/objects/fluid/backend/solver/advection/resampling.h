#pragma once

#include "objects/fluid/backend/solver/advection/advection.h"
#include "objects/fluid/backend/solver/grid.h"

namespace grove::objects::fluid {

/// Carries a field over to a grid of the same cube with other cells, trilinearly between the places where its values
/// lie: exact for what is linear in space. Ghosts of `from` must be filled; those of `to` are left alone.
void resample(const Layout& fromLayout, const Field& from, Place place, const Layout& toLayout, Field& to);

}  // namespace grove::objects::fluid
