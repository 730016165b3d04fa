#pragma once

#include "objects/fluid/backend/solver/grid.h"
#include "objects/fluid/backend/solver/pressure/pressure_operator.h"

namespace grove::objects::fluid {

/// One sweep of successive over-relaxation of A x = b in red-black order (Young 1954), with the optimal factor for a
/// box without solids. The baseline that other solvers are compared with.
void sweepRedBlack(const Layout& layout, const rows::FineOperator& a, const Field& b, Field& x);

}  // namespace grove::objects::fluid
