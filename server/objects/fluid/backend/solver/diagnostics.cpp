#include "objects/fluid/backend/solver/diagnostics.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::fluid {

namespace {

template <class Visit>
void forEachAirCell(const SolidGrid& solids, const Visit& visit) {
  const Layout& layout = solids.layout();
  CellBox::whole(layout.cells).forEach([&](int x, int y, int z) {
    const std::ptrdiff_t i = layout.index(x, y, z);
    if (solids.air()[i] != 0) visit(i);
  });
}

template <class Visit>
void forEachNeighbour(const Layout& layout, std::ptrdiff_t i, const Visit& visit) {
  for (int a = 0; a < 3; ++a) {
    visit(i - layout.step(a));
    visit(i + layout.step(a));
  }
}

}  // namespace

double relativeResidual(const SolidGrid& solids, const Field& pressure, const Field& rightHandSide) {
  double squaredResidual = 0.0;
  double squaredB = 0.0;
  forEachAirCell(solids, [&](std::ptrdiff_t i) {
    const double b = static_cast<double>(rightHandSide[i]);
    double r = b;
    forEachNeighbour(solids.layout(), i, [&](std::ptrdiff_t j) {
      if (solids.air()[j] != 0) r -= static_cast<double>(pressure[i]) - static_cast<double>(pressure[j]);
    });
    squaredResidual += r * r;
    squaredB += b * b;
  });
  return squaredB > 0.0 ? std::sqrt(squaredResidual / squaredB) : std::sqrt(squaredResidual);
}

double largestNetFlow(const SolidGrid& solids, const Velocity& velocity) {
  double largest = 0.0;
  forEachAirCell(solids, [&](std::ptrdiff_t i) {
    bool anyOpen = false;
    forEachNeighbour(solids.layout(), i, [&](std::ptrdiff_t j) { anyOpen = anyOpen || solids.air()[j] != 0; });
    if (!anyOpen) return;
    double flow = 0.0;
    for (int a = 0; a < 3; ++a) {
      const Field& faces = velocity.axis(a);
      flow += static_cast<double>(faces[i + solids.layout().step(a)]) - static_cast<double>(faces[i]);
    }
    largest = std::max(largest, std::fabs(flow));
  });
  return largest;
}

}  // namespace grove::objects::fluid
