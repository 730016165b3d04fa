#pragma once

#include "objects/fluid/backend/solver/advection/advection.h"
#include "objects/fluid/backend/solver/grid.h"

namespace grove::objects::fluid {

/// Resamples a field to another grid of the same cube, trilinearly between the values' locations: exact for linear
/// functions. Ghosts of `from` must be filled; ghosts of `to` stay unchanged.
void resample(const Layout& fromLayout, const Field& from, Place place, const Layout& toLayout, Field& to);

}  // namespace grove::objects::fluid
