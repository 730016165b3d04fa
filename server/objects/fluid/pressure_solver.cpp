#include "objects/fluid/pressure_solver.h"

#include <cmath>

#include "objects/fluid/projection.h"

namespace grove::objects::fluid {

PressureSolver::PressureSolver(const Layout& layout)
    : layout_(layout),
      multigrid_(layout),
      b_(layout.size()),
      x_(layout.size()),
      r_(layout.size()),
      z_(layout.size()),
      az_(layout.size()),
      p_(layout.size()),
      ap_(layout.size()) {}

void PressureSolver::refresh(SolidGrid& solids) {
  const CellBox changed = solids.takeChanges();
  if (changed.empty()) return;
  multigrid_.rebuild(solids, changed);
  pockets_.find(solids);
  maskSolids(layout_, multigrid_.diagonal(), x_);
}

PressureSolver::Outcome PressureSolver::project(SolidGrid& solids, Velocity& velocity, const Options& options) {
  refresh(solids);
  negativeDivergence(layout_, velocity, multigrid_.diagonal(), b_);
  const Outcome outcome = iterate(b_, options);
  subtractGradient(layout_, x_, velocity);
  solids.enforce(velocity);
  return outcome;
}

PressureSolver::Outcome PressureSolver::solve(SolidGrid& solids, Field& b, const Options& options) {
  refresh(solids);
  maskSolids(layout_, multigrid_.diagonal(), b);
  b_.copyFrom(b);
  const Outcome outcome = iterate(b_, options);
  b.copyFrom(b_);
  return outcome;
}

PressureSolver::Outcome PressureSolver::iterate(Field& b, const Options& options) {
  pockets_.removeMeans(b);
  double squared = 0.0;
  const double squaredB = initialResidual(layout_, multigrid_.finest(), b, x_, r_, squared);
  Outcome outcome;
  if (!(squaredB > 1.0e-30)) {
    x_.clear();
    return outcome;
  }
  const double enough = squaredB * static_cast<double>(options.tolerance) * static_cast<double>(options.tolerance);
  if (squared > squaredB) {
    // The last pressure is worse than none, as after a jump of the scene.
    x_.clear();
    squared = initialResidual(layout_, multigrid_.finest(), b, x_, r_, squared);
  }
  double gamma = 0.0;
  double alpha = 0.0;
  while (squared > enough && outcome.iterations < options.mostIterations) {
    pockets_.removeMeans(r_);
    const Multigrid::Products products = multigrid_.apply(r_, z_, az_);
    double beta = 0.0;
    double curvature = products.resultDotOperator;
    if (outcome.iterations > 0) {
      beta = products.residualDotResult / gamma;
      curvature -= beta * products.residualDotResult / alpha;
    }
    gamma = products.residualDotResult;
    if (!(curvature > 0.0) || !(gamma > 0.0)) break;
    alpha = gamma / curvature;
    squared = advance(layout_, static_cast<float>(alpha), static_cast<float>(beta), z_, az_, p_, ap_, x_, r_);
    ++outcome.iterations;
  }
  outcome.residual = static_cast<float>(std::sqrt(squared / squaredB));
  return outcome;
}

}  // namespace grove::objects::fluid
