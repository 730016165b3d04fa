#include "objects/fluid/projection.h"

#include <numeric>
#include <vector>

#include "objects/fluid/multigrid_rows.h"

namespace grove::objects::fluid {

namespace {

template <class Body>
void forEachRow(const Layout& layout, const Body& body) {
  for (int z = 0; z < layout.cells; ++z) {
    for (int y = 0; y < layout.cells; ++y) body(layout.index(0, y, z));
  }
}

}  // namespace

double negativeDivergence(const Layout& layout, const Velocity& velocity, const Array<std::uint8_t>& diagonal,
                          Field& out, Team& team) {
  const int n = layout.cells;
  const std::ptrdiff_t s = layout.step(1);
  const std::ptrdiff_t p = layout.step(2);
  std::vector<double> squared(static_cast<std::size_t>(n));  // of each plane, so that the order of their sum is fixed
  const auto row = [&](std::ptrdiff_t at) {
    const float* u = velocity.x.data() + at;
    const float* v = velocity.y.data() + at;
    const float* w = velocity.z.data() + at;
    const std::uint8_t* d = diagonal.data() + at;
    float* __restrict b = out.data() + at;
    float sum = 0.0F;
    for (int i = 0; i < n; ++i) {
      const float flow = (u[i] - u[i + 1]) + (v[i] - v[i + s]) + (w[i] - w[i + p]);
      b[i] = d[i] != 0 ? flow : 0.0F;
      sum += b[i] * b[i];
    }
    return static_cast<double>(sum);
  };
  team.run([&](int part) {
    const Slab slab = Slab::of(part, team.width(), n);
    for (int z = slab.first; z < slab.end; ++z) {
      for (int y = 0; y < n; ++y) squared[static_cast<std::size_t>(z)] += row(layout.index(0, y, z));
    }
  });
  return std::accumulate(squared.begin(), squared.end(), 0.0);
}

void subtractGradient(const Layout& layout, const Field& pressure, Velocity& velocity, Team& team) {
  const int n = layout.cells;
  const std::ptrdiff_t s = layout.step(1);
  const std::ptrdiff_t p = layout.step(2);
  const auto row = [&](std::ptrdiff_t at, int length, float* faces, std::ptrdiff_t step) {
    const float* x = pressure.data() + at;
    float* __restrict out = faces + at;
    for (int i = 0; i < length; ++i) out[i] -= x[i] - x[i - step];
  };
  team.run([&](int part) {
    const Slab slab = Slab::of(part, team.width(), n);
    for (int z = slab.first; z < slab.end + (slab.end == n ? 1 : 0); ++z) {
      for (int y = 0; y <= n; ++y) {
        const std::ptrdiff_t at = layout.index(0, y, z);
        if (y < n && z < n) row(at, n + 1, velocity.x.data(), 1);
        if (z < n) row(at, n, velocity.y.data(), s);
        if (y < n) row(at, n, velocity.z.data(), p);
      }
    }
  });
}

void maskSolids(const Layout& layout, const Array<std::uint8_t>& diagonal, Field& values) {
  forEachRow(layout, [&](std::ptrdiff_t at) {
    const std::uint8_t* d = diagonal.data() + at;
    float* __restrict v = values.data() + at;
    for (int i = 0; i < layout.cells; ++i) v[i] = d[i] != 0 ? v[i] : 0.0F;
  });
}

double initialResidual(const Layout& layout, const rows::FineOperator& a, const Field& b, const Field& x, Field& r) {
  const std::ptrdiff_t p = layout.step(2);
  double squared = 0.0;
  forEachRow(layout, [&](std::ptrdiff_t at) {
    float* out = r.data() + at;
    const float* unknown = x.data() + at;
    rows::residual(a.row(at), b.data() + at, {unknown - p, unknown, unknown + p}, out, layout.cells);
    float sum = 0.0F;
    for (int i = 0; i < layout.cells; ++i) sum += out[i] * out[i];
    squared += static_cast<double>(sum);
  });
  return squared;
}

double advance(const Layout& layout, float alpha, float beta, const Field& z, const Field& az, Field& p, Field& ap,
               Field& x, Field& r) {
  double squared = 0.0;
  forEachRow(layout, [&](std::ptrdiff_t at) {
    const float* zr = z.data() + at;
    const float* azr = az.data() + at;
    float* __restrict pr = p.data() + at;
    float* __restrict apr = ap.data() + at;
    float* __restrict xr = x.data() + at;
    float* __restrict rr = r.data() + at;
    float sum = 0.0F;
    for (int i = 0; i < layout.cells; ++i) {
      const float direction = zr[i] + beta * pr[i];
      const float image = azr[i] + beta * apr[i];
      const float residual = rr[i] - alpha * image;
      pr[i] = direction;
      apr[i] = image;
      xr[i] += alpha * direction;
      rr[i] = residual;
      sum += residual * residual;
    }
    squared += static_cast<double>(sum);
  });
  return squared;
}

}  // namespace grove::objects::fluid
