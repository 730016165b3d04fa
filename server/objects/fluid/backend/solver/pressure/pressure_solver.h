#pragma once

#include <memory>

#include "objects/fluid/backend/solver/grid.h"
#include "objects/fluid/backend/solver/pressure/conjugate_gradients.h"
#include "objects/fluid/backend/solver/pressure/multigrid.h"
#include "objects/fluid/backend/solver/pressure/pockets.h"
#include "objects/fluid/backend/solver/solid_grid.h"
#include "objects/fluid/backend/solver/team.h"

namespace grove::objects::fluid {

/// Makes a velocity free of divergence: solves the pressure equation by multigrid, starting from the last step's
/// pressure. Where plain cycles converge slowly, as amid rubble finer than the coarse cells, conjugate gradients
/// preconditioned with a V-cycle continue. Used by one thread.
class PressureSolver {
 public:
  struct Options {
    float tolerance = 1.0e-4F;  ///< relative L2 residual
    int maxIterations = 60;
  };
  struct SolveResult {
    int iterations = 0;
    float residual = 0.0F;  ///< relative L2, to a few hundredths
  };

  explicit PressureSolver(const Layout& layout, std::shared_ptr<Team> team = std::make_shared<Team>(1));

  /// Applies the changes of the solids, as project() does first; slow if all solids are new.
  void prepare(SolidGrid& solids);

  /// The projection of Stam 1999: afterwards the net flow out of every air cell is zero to the tolerance. Before and
  /// after, the velocity's faces at solids hold the solids' velocity (SolidGrid::enforce()).
  SolveResult project(SolidGrid& solids, Velocity& velocity, const Options& options);

  /// Solves for another right-hand side: sum over open faces of (p - p of the neighbour) = b. Makes `b` solvable: zero
  /// in solids, each pocket's mean subtracted.
  SolveResult solve(SolidGrid& solids, Field& b, const Options& options);

  /// Metres a second: pressure * time step / (density * cell size). Zero in solids.
  [[nodiscard]] const Field& pressure() const noexcept { return x_; }
  /// The right-hand side of the last solve.
  [[nodiscard]] const Field& rightHandSide() const noexcept { return b_; }
  /// Forgets the last step's pressure.
  void forget() noexcept { x_.clear(); }

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept {
    return multigrid_.bytes() + pockets_.bytes() + gradients_.bytes() + heldBytes(b_, x_, next_);
  }

 private:
  SolveResult iterate(double squaredB, const Options& options);
  FineSweep::Norms cycle(bool first);

  const Layout layout_;
  const std::shared_ptr<Team> team_;
  Multigrid multigrid_;
  Pockets pockets_;
  ConjugateGradients gradients_;
  Field b_, x_, next_;
};

}  // namespace grove::objects::fluid
