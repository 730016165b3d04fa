#include "objects/fluid/backend/solver/pressure/red_black.h"

#include <cmath>

#include "objects/fluid/backend/solver/pressure/projection_kernels.h"

namespace grove::objects::fluid {

void sweepRedBlack(const Layout& layout, const rows::FineOperator& a, const Field& b, Field& x) {
  const int n = layout.cells;
  const float relax = 2.0F / (1.0F + std::sin(3.14159265F / static_cast<float>(n + 1)));
  // Black follows one plane behind red, while the planes are in the cache.
  for (int sweep = 0; sweep <= n; ++sweep) {
    for (int colour = 0; colour < 2; ++colour) {
      const int z = sweep - colour;
      if (z >= 0 && z < n) relaxPlane(layout, z, a, b.data(), colour, relax, x.data());
    }
  }
}

}  // namespace grove::objects::fluid
