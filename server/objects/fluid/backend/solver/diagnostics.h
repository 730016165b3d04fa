#pragma once

#include "objects/fluid/backend/solver/grid.h"
#include "objects/fluid/backend/solver/solid_grid.h"

/// What benches and tests say about a solution, computed from its definition in double precision and with nothing of
/// the solver's own arithmetic.
namespace grove::objects::fluid {

/// |b - A p| / |b| over all air cells.
[[nodiscard]] double relativeResidual(const SolidGrid& solids, const Field& pressure, const Field& rightHandSide);

/// Largest |net flow out of an air cell| in metres a second; over the cell size it is the divergence. Cells whose faces
/// are all closed are left out: nothing can be done about their flow.
[[nodiscard]] double largestNetFlow(const SolidGrid& solids, const Velocity& velocity);

/// Half the sum of the squared face velocities, in cells * (metres a second) squared.
[[nodiscard]] double kineticEnergy(const Layout& layout, const Velocity& velocity);

}  // namespace grove::objects::fluid
