#include "objects/fluid/conjugate_gradients.h"

#include "objects/fluid/projection.h"

namespace grove::objects::fluid {

ConjugateGradients::ConjugateGradients(const Layout& layout)
    : layout_(layout),
      r_(layout.size()),
      z_(layout.size()),
      az_(layout.size()),
      p_(layout.size()),
      ap_(layout.size()) {}

double ConjugateGradients::solve(const rows::FineOperator& a, const Pockets& pockets,
                                 const Preconditioner& preconditioner, const Field& b, Field& x, double enough,
                                 int mostIterations, int& iterations) {
  double squared = initialResidual(layout_, a, b, x, r_);
  double gamma = 0.0;
  double alpha = 0.0;
  for (bool first = true; squared > enough && iterations < mostIterations; first = false) {
    pockets.removeMeans(r_);
    const Multigrid::Products products = preconditioner(r_, z_, az_);
    double beta = 0.0;
    double curvature = products.resultDotOperator;
    if (!first) {
      beta = products.residualDotResult / gamma;
      curvature -= beta * products.residualDotResult / alpha;
    }
    gamma = products.residualDotResult;
    if (!(curvature > 0.0) || !(gamma > 0.0)) break;
    alpha = gamma / curvature;
    squared = advance(layout_, static_cast<float>(alpha), static_cast<float>(beta), z_, az_, p_, ap_, x, r_);
    ++iterations;
  }
  return squared;
}

Multigrid::Products applyDiagonal(const Layout& layout, const rows::FineOperator& a, const Field& residual,
                                  Field& result, Field& operatorResult) {
  const std::ptrdiff_t p = layout.step(2);
  const auto scale = [&](int z) {
    for (int y = 0; y < layout.cells; ++y) {
      const std::ptrdiff_t at = layout.index(0, y, z);
      const rows::FineOperator::Row row = a.row(at);
      const float* in = residual.data() + at;
      float* __restrict out = result.data() + at;
      for (int i = 0; i < layout.cells; ++i) out[i] = row.inverse(i) * in[i];
    }
  };
  Multigrid::Products products;
  scale(0);
  for (int z = 0; z < layout.cells; ++z) {
    if (z + 1 < layout.cells) scale(z + 1);
    float rz = 0.0F;
    float zaz = 0.0F;
    for (int y = 0; y < layout.cells; ++y) {
      const std::ptrdiff_t at = layout.index(0, y, z);
      const float* here = result.data() + at;
      rows::applyOperator(a.row(at), residual.data() + at, {here - p, here, here + p}, operatorResult.data() + at,
                          layout.cells, rz, zaz);
    }
    products.residualDotResult += static_cast<double>(rz);
    products.resultDotOperator += static_cast<double>(zaz);
  }
  return products;
}

}  // namespace grove::objects::fluid
