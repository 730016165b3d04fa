#include "objects/fluid/backend/solver/pressure/conjugate_gradients.h"

#include "objects/fluid/backend/solver/pressure/projection.h"
#include "objects/fluid/backend/solver/pressure/projection_kernels.h"

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
                                 int maxIterations, int& iterations) {
  double squared = initialResidual(layout_, a, b, x, r_);
  double gamma = 0.0;
  double alpha = 0.0;
  for (bool first = true; squared > enough && iterations < maxIterations; first = false) {
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
  const auto scale = [&](int z) { divideByDiagonalPlane(layout, z, a, residual.data(), result.data()); };
  Multigrid::Products products;
  scale(0);
  for (int z = 0; z < layout.cells; ++z) {
    if (z + 1 < layout.cells) scale(z + 1);
    const Multigrid::Products plane =
        applyOperatorPlane(layout, z, a, residual.data(), result.data(), operatorResult.data());
    products.residualDotResult += plane.residualDotResult;
    products.resultDotOperator += plane.resultDotOperator;
  }
  return products;
}

}  // namespace grove::objects::fluid
