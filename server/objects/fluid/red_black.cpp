#include "objects/fluid/red_black.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::fluid {

void sweepRedBlack(const Layout& layout, const rows::FineOperator& a, const Field& b, Field& x) {
  const int n = layout.cells;
  const float relax = 2.0F / (1.0F + std::sin(3.14159265F / static_cast<float>(n + 1)));
  const std::ptrdiff_t p = layout.step(2);
  // Black follows one plane behind red, while the planes are in the cache.
  for (int wave = 0; wave <= n; ++wave) {
    for (int colour = 0; colour < 2; ++colour) {
      const int z = wave - colour;
      if (z < 0 || z >= n) continue;
      for (int y = 0; y < n; ++y) {
        const std::ptrdiff_t at = layout.index(0, y, z);
        const rows::FineOperator::Row row = a.row(at);
        const float* in = b.data() + at;
        float* own = x.data() + at;
        const rows::Around3 around{own - p, own, own + p};
        const int other = (y + z + colour) & 1;
        // Cells of the other colour stay as they are, so that rows vectorise. Written to a row aside first: loads that
        // overlap the store just before them would wait for it.
        alignas(64) float solvedRow[rows::kLongestRow];
        for (int i = 0; i < n; ++i) {
          const float share = ((i ^ other) & 1) == 0 ? relax : 0.0F;
          const float solved = row.inverse(i) * (in[i] + row.neighbours(around, i));
          solvedRow[i] = own[i] + (row.weight(i) > 0.0F ? share * (solved - own[i]) : 0.0F);
        }
        std::copy_n(solvedRow, n, own);
      }
    }
  }
}

}  // namespace grove::objects::fluid
