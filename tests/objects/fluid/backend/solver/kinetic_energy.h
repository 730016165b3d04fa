#pragma once

#include "objects/fluid/backend/solver/grid.h"

namespace grove::objects::fluid {

/// Half the sum of the squared face velocities, in cells * (metres per second) squared.
[[nodiscard]] inline double kineticEnergy(const Layout& layout, const Velocity& velocity) {
  double sum = 0.0;
  for (int a = 0; a < 3; ++a) {
    for (int z = 0; z < layout.cells; ++z) {
      for (int y = 0; y < layout.cells; ++y) {
        for (int x = 0; x < layout.cells; ++x) {
          const double v = static_cast<double>(velocity.axis(a)[layout.index(x, y, z)]);
          sum += 0.5 * v * v;
        }
      }
    }
  }
  return sum;
}

}  // namespace grove::objects::fluid
