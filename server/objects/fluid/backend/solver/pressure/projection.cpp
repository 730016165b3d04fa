#include "objects/fluid/backend/solver/pressure/projection.h"

#include <numeric>
#include <vector>

#include "objects/fluid/backend/solver/pressure/projection_kernels.h"

namespace grove::objects::fluid {

namespace {

/// Sums the results of `plane` over all planes.
template <class Plane>
double sumOverPlanes(const Layout& layout, const Plane& plane) {
  double sum = 0.0;
  for (int z = 0; z < layout.cells; ++z) sum += plane(z);
  return sum;
}

}  // namespace

double negativeDivergence(const Layout& layout, const Velocity& velocity, const Array<std::uint8_t>& diagonal,
                          Field& out, Team& team) {
  const ConstVelocityPointers faces{velocity.x.data(), velocity.y.data(), velocity.z.data()};
  // One sum per plane, so that the order of summation is fixed.
  std::vector<double> squared(static_cast<std::size_t>(layout.cells));
  team.run([&](int part) {
    const Slab slab = Slab::of(part, team.width(), layout.cells);
    for (int z = slab.first; z < slab.end; ++z) {
      squared[static_cast<std::size_t>(z)] = divergencePlane(layout, z, faces, diagonal.data(), out.data());
    }
  });
  return std::accumulate(squared.begin(), squared.end(), 0.0);
}

void subtractGradient(const Layout& layout, const Field& pressure, Velocity& velocity, Team& team) {
  const VelocityPointers faces{velocity.x.data(), velocity.y.data(), velocity.z.data()};
  team.run([&](int part) {
    const Slab slab = Slab::of(part, team.width(), layout.cells);
    const int end = slab.end + (slab.end == layout.cells ? 1 : 0);
    for (int z = slab.first; z < end; ++z) subtractGradientPlane(layout, z, pressure.data(), faces);
  });
}

void maskSolids(const Layout& layout, const Array<std::uint8_t>& diagonal, Field& values) {
  for (int z = 0; z < layout.cells; ++z) maskPlane(layout, z, diagonal.data(), values.data());
}

double initialResidual(const Layout& layout, const rows::FineOperator& a, const Field& b, const Field& x, Field& r) {
  return sumOverPlanes(layout, [&](int z) { return residualPlane(layout, z, a, b.data(), x.data(), r.data()); });
}

double advance(const Layout& layout, float alpha, float beta, const Field& z, const Field& az, Field& p, Field& ap,
               Field& x, Field& r) {
  const GradientPointers fields{z.data(), az.data(), p.data(), ap.data(), x.data(), r.data()};
  return sumOverPlanes(layout, [&](int plane) { return advancePlane(layout, plane, alpha, beta, fields); });
}

}  // namespace grove::objects::fluid
