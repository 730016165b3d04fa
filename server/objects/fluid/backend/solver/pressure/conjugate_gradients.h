#pragma once

#include <functional>

#include "objects/fluid/backend/solver/grid.h"
#include "objects/fluid/backend/solver/pressure/multigrid.h"
#include "objects/fluid/backend/solver/pressure/pockets.h"

namespace grove::objects::fluid {

/// Preconditioned conjugate gradients for the pressure equation, in Chronopoulos and Gear's form: one reduction per
/// iteration. One thread; keeps its vectors.
class ConjugateGradients {
 public:
  explicit ConjugateGradients(const Layout& layout);

  /// result = M residual, operatorResult = A result, and their dot products. M must be symmetric positive definite.
  using Preconditioner =
      std::function<Multigrid::Products(const Field& residual, Field& result, Field& operatorResult)>;

  /// Improves `x`, counting `iterations` up to `maxIterations`, until the squared residual is at most `enough`. Returns
  /// the squared residual as the method's own recurrence computes it.
  double solve(const rows::FineOperator& a, const Pockets& pockets, const Preconditioner& preconditioner,
               const Field& b, Field& x, double enough, int maxIterations, int& iterations);

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept { return heldBytes(r_, z_, az_, p_, ap_); }

 private:
  const Layout layout_;
  Field r_, z_, az_, p_, ap_;
};

/// Jacobi preconditioner: the diagonal of A.
Multigrid::Products applyDiagonal(const Layout& layout, const rows::FineOperator& a, const Field& residual,
                                  Field& result, Field& operatorResult);

}  // namespace grove::objects::fluid
