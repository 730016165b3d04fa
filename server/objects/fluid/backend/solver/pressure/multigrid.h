#pragma once

#include <memory>
#include <vector>

#include "objects/fluid/backend/solver/grid.h"
#include "objects/fluid/backend/solver/pressure/fine_sweep.h"
#include "objects/fluid/backend/solver/pressure/multigrid_kernels.h"
#include "objects/fluid/backend/solver/pressure/pressure_operator.h"
#include "objects/fluid/backend/solver/solid_grid.h"

namespace grove::objects::fluid {

/// One symmetric V-cycle as a preconditioner for the pressure equation (after McAdams, Sifakis and Teran 2010, "A
/// parallel multigrid Poisson solver for fluids simulation on large grids"), with four differences:
///
/// - Coarse faces carry the open share of their fine faces instead of a whole-cell type, so walls of one cell stay
///   walls.
/// - Interpolation is linear along each axis and weighted with that share. It never reaches through a closed face and
///   meets an open side's pressure exactly. Restriction is its transpose.
/// - The smoother is a Chebyshev polynomial of Jacobi (Adams et al. 2003), which is independent of colours and order.
/// - Smoothing, residual, restriction and operator run as sweeps over z-planes: each level is read once on the way down
///   and once on the way up.
///
/// The equation in a cell is sum over open faces of (p - p of the neighbour) = right-hand side. Used by one thread;
/// cycle() runs on its team.
class Multigrid {
 public:
  /// `cells` must be even. Each level halves it, while it stays even.
  explicit Multigrid(const Layout& layout, std::shared_ptr<Team> team = std::make_shared<Team>(1));
  ~Multigrid();
  Multigrid(const Multigrid&) = delete;
  Multigrid& operator=(const Multigrid&) = delete;

  /// Updates the solids within the box of changed cells.
  void rebuild(const SolidGrid& solids, const CellBox& changed);

  using Products = MultigridProducts;

  /// result = M residual; operatorResult = A result. Ghosts and solids of `residual` must be zero, and stay so.
  Products apply(const Field& residual, Field& result, Field& operatorResult);

  /// One multigrid step on its own: next = x, corrected. The first step of a solve has no correction yet: it smooths
  /// and restricts the residual for the following steps.
  FineSweep::Norms cycle(const Field& b, const Field& x, Field& next, bool first);

  [[nodiscard]] rows::FineOperator finest() const noexcept {
    return {diagonal_.data(), sixtieths_.data(), layout_.step(1)};
  }
  /// Number of open faces of every air cell, 0 in solids: the diagonal of A.
  [[nodiscard]] const Array<std::uint8_t>& diagonal() const noexcept { return diagonal_; }

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  struct Level;
  void countFaces(const Array<std::uint8_t>& air, const CellBox& box);
  void solveBelow(std::size_t level);

  const Layout layout_;
  Array<std::uint8_t> diagonal_;
  Array<std::uint8_t> sixtieths_;               ///< 60 / diagonal
  std::vector<std::unique_ptr<Level>> levels_;  ///< coarser and coarser; without the finest
  FineSweep fine_;
  Field odd_;       ///< planes of the finest level's smoother
  Field residual_;  ///< planes of the finest level's residual
};

}  // namespace grove::objects::fluid
