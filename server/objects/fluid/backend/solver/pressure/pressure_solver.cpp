#include "objects/fluid/backend/solver/pressure/pressure_solver.h"

#include <cmath>
#include <utility>

#include "objects/fluid/backend/solver/pressure/projection.h"

namespace grove::objects::fluid {

PressureSolver::PressureSolver(const Layout& layout, std::shared_ptr<Team> team)
    : layout_(layout),
      team_(std::move(team)),
      multigrid_(layout, team_),
      gradients_(layout),
      b_(layout.size()),
      x_(layout.size()),
      next_(layout.size()) {}

void PressureSolver::prepare(SolidGrid& solids) {
  const CellBox changed = solids.takeChanges();
  if (changed.empty()) return;
  multigrid_.rebuild(solids, changed);
  pockets_.find(solids);
  maskSolids(layout_, multigrid_.diagonal(), x_);
}

PressureSolver::SolveResult PressureSolver::project(SolidGrid& solids, Velocity& velocity, const Options& options) {
  prepare(solids);
  const double squaredB = negativeDivergence(layout_, velocity, multigrid_.diagonal(), b_, *team_);
  const SolveResult result = iterate(squaredB, options);
  subtractGradient(layout_, x_, velocity, *team_);
  solids.enforce(velocity);
  return result;
}

PressureSolver::SolveResult PressureSolver::solve(SolidGrid& solids, Field& b, const Options& options) {
  prepare(solids);
  maskSolids(layout_, multigrid_.diagonal(), b);
  b_.copyFrom(b);
  double squaredB = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const double value = static_cast<double>(b[static_cast<std::ptrdiff_t>(i)]);
    squaredB += value * value;
  }
  const SolveResult result = iterate(squaredB, options);
  b.copyFrom(b_);
  return result;
}

FineSweep::Norms PressureSolver::cycle(bool first) {
  const FineSweep::Norms norms = multigrid_.cycle(b_, x_, next_, first);
  std::swap(x_, next_);
  return norms;
}

PressureSolver::SolveResult PressureSolver::iterate(double squaredB, const Options& options) {
  constexpr double kNothing = 1.0e-30;
  constexpr double kCertainly = 0.9;  // margin: the cycle's estimate of its residual is accurate to a few hundredths
  constexpr double kSlow = 0.04;      // share of the squared residual; a cycle leaves less than this in common scenes
  SolveResult result;
  if (!(squaredB > kNothing)) {
    x_.clear();
    return result;
  }
  pockets_.removeMeans(b_);
  FineSweep::Norms norms = cycle(true);
  if (norms.before > norms.b) {
    // The last pressure is worse than zero, as after a jump of the scene.
    x_.clear();
    norms = cycle(true);
  }
  if (!(norms.b > kNothing)) {
    x_.clear();
    return result;
  }
  const double enough = norms.b * static_cast<double>(options.tolerance) * static_cast<double>(options.tolerance);
  double squared = norms.after;
  while (squared > kCertainly * enough && result.iterations < options.maxIterations) {
    norms = cycle(false);
    ++result.iterations;
    const bool slow = norms.after > kSlow * squared;
    squared = norms.after;
    if (slow && squared > kCertainly * enough) {
      const auto precondition = [this](const Field& r, Field& z, Field& az) { return multigrid_.apply(r, z, az); };
      squared = gradients_.solve(multigrid_.finest(), pockets_, precondition, b_, x_, enough, options.maxIterations,
                                 result.iterations);
      break;
    }
  }
  result.residual = static_cast<float>(std::sqrt(squared / norms.b));
  return result;
}

}  // namespace grove::objects::fluid
