#pragma once

#include <cstdint>

#include "objects/fluid/backend/solver/grid.h"
#include "objects/fluid/backend/solver/pressure/multigrid_kernels.h"
#include "objects/fluid/backend/solver/pressure/pressure_operator.h"

/// Passes around the pressure solve and of the simpler solvers, each over the plane `z`; pointers are to whole fields
/// of a Layout. Ghosts of all fields except the velocity are zero and stay so.
namespace grove::objects::fluid {

struct ConstVelocityPointers {
  const float* x;
  const float* y;
  const float* z;
};
struct VelocityPointers {
  float* x;
  float* y;
  float* z;
};

/// out = minus the net flow out of each air cell; zero in solids. Returns out.out.
double divergencePlane(const Layout& layout, int z, const ConstVelocityPointers& velocity, const std::uint8_t* diagonal,
                       float* out);

/// velocity -= gradient of the pressure, at the low faces of the plane's cells and above; z may equal the number of
/// cells.
void subtractGradientPlane(const Layout& layout, int z, const float* pressure, const VelocityPointers& velocity);

/// values = 0 where the diagonal is 0.
void maskPlane(const Layout& layout, int z, const std::uint8_t* diagonal, float* values);

/// r = b - A x. Returns r.r.
double residualPlane(const Layout& layout, int z, const rows::FineOperator& a, const float* b, const float* x,
                     float* r);

/// Vectors of conjugate gradients.
struct GradientPointers {
  const float* z;
  const float* az;
  float* p;
  float* ap;
  float* x;
  float* r;
};
/// p = z + beta p, ap = az + beta ap, x += alpha p, r -= alpha ap. Returns r.r.
double advancePlane(const Layout& layout, int z, float alpha, float beta, const GradientPointers& fields);

/// out = r / diagonal.
void divideByDiagonalPlane(const Layout& layout, int z, const rows::FineOperator& a, const float* r, float* out);

/// out = A x.
MultigridProducts applyOperatorPlane(const Layout& layout, int z, const rows::FineOperator& a, const float* r,
                                     const float* x, float* out);

/// Over-relaxes the cells of one colour, those with even x + y + z + colour, by the factor `relax`.
void relaxPlane(const Layout& layout, int z, const rows::FineOperator& a, const float* b, int colour, float relax,
                float* x);

}  // namespace grove::objects::fluid
