#pragma once

#include "objects/fluid/backend/solver/grid.h"
#include "objects/fluid/backend/solver/solid_grid.h"

/// Error measures for benches and tests, computed from their definitions in double precision, independent of the
/// solver's arithmetic.
namespace grove::objects::fluid {

/// |b - A p| / |b| over all air cells.
[[nodiscard]] double relativeResidual(const SolidGrid& solids, const Field& pressure, const Field& rightHandSide);

/// Largest |net flow out of an air cell| in metres per second; divided by the cell size it is the divergence. Skips
/// cells whose faces are all closed, because the solver cannot change their flow.
[[nodiscard]] double largestNetFlow(const SolidGrid& solids, const Velocity& velocity);

}  // namespace grove::objects::fluid
