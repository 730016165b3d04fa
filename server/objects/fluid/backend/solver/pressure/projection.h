#pragma once

#include <cstdint>

#include "objects/fluid/backend/solver/grid.h"
#include "objects/fluid/backend/solver/pressure/pressure_operator.h"
#include "objects/fluid/backend/solver/team.h"

/// Vector passes around the pressure solve. Ghosts of all fields except the velocity are zero and stay so.
namespace grove::objects::fluid {

/// out = minus the net flow out of each air cell, in metres per second; zero in solids. Returns out.out.
double negativeDivergence(const Layout& layout, const Velocity& velocity, const Array<std::uint8_t>& diagonal,
                          Field& out, Team& team);

/// velocity -= gradient of the pressure, at every face.
void subtractGradient(const Layout& layout, const Field& pressure, Velocity& velocity, Team& team);

/// values = 0 where the diagonal is 0.
void maskSolids(const Layout& layout, const Array<std::uint8_t>& diagonal, Field& values);

/// r = b - A x. Returns r.r.
double initialResidual(const Layout& layout, const rows::FineOperator& a, const Field& b, const Field& x, Field& r);

/// One step of conjugate gradients: p = z + beta p, ap = az + beta ap, x += alpha p, r -= alpha ap. Returns r.r.
double advance(const Layout& layout, float alpha, float beta, const Field& z, const Field& az, Field& p, Field& ap,
               Field& x, Field& r);

}  // namespace grove::objects::fluid
