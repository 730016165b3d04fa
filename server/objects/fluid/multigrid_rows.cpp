#include "objects/fluid/multigrid_rows.h"

namespace grove::objects::fluid::rows {

void restrictRow(const Around& fine, const CoarseOperator::Row& weights, float* out, int coarseCells) {
  // Sums over the four fine rows of the coarse row, and what crosses its four sides, still at fine resolution in x.
  constexpr int kLead = 16;
  // One half would be consistent. A tenth more was measured to save one iteration of four amid obstacles; twice that
  // is worse again.
  constexpr float kScale = 0.55F;
  alignas(64) float all[kLongestRow + 2 * kLead];
  alignas(64) float lowY[kLongestRow];
  alignas(64) float highY[kLongestRow];
  alignas(64) float lowZ[kLongestRow];
  alignas(64) float highZ[kLongestRow];
  const int n = 2 * coarseCells;
  const auto& r = fine.row;
  float* sum = all + kLead;
  for (int i = 0; i < n; ++i) {
    const float a = r[1][1][i];
    const float b = r[1][2][i];
    const float c = r[2][1][i];
    const float d = r[2][2][i];
    sum[i] = (a + b) + (c + d);
    lowY[i] = (r[1][0][i] + r[2][0][i]) - (a + c);
    highY[i] = (r[1][3][i] + r[2][3][i]) - (b + d);
    lowZ[i] = (r[0][1][i] + r[0][2][i]) - (a + b);
    highZ[i] = (r[3][1][i] + r[3][2][i]) - (c + d);
  }
  sum[-1] = 0.0F;
  sum[n] = 0.0F;
  const float* wx = weights.wx;
  const float* wy = weights.wy;
  const float* wz = weights.wz;
  const std::ptrdiff_t s = weights.s;
  const std::ptrdiff_t p = weights.p;
  for (int i = 0; i < coarseCells; ++i) {
    const float own = sum[2 * i] + sum[2 * i + 1];
    const float x = wx[i] * (sum[2 * i - 1] - sum[2 * i]) + wx[i + 1] * (sum[2 * i + 2] - sum[2 * i + 1]);
    const float y = wy[i] * (lowY[2 * i] + lowY[2 * i + 1]) + wy[i + s] * (highY[2 * i] + highY[2 * i + 1]);
    const float z = wz[i] * (lowZ[2 * i] + lowZ[2 * i + 1]) + wz[i + p] * (highZ[2 * i] + highZ[2 * i + 1]);
    out[i] = kScale * (own + 0.25F * (x + y + z));
  }
}

}  // namespace grove::objects::fluid::rows
