#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "objects/fluid/backend/solver/grid.h"

/// What the inner loops of the multigrid work on. `s` and `p` are the distances to the next row and plane.
namespace grove::objects::fluid::rows {

/// Cells of the longest row.
inline constexpr int kLongestRow = 128;

/// Rows are worked on in whole vectors: behind a row lie ghosts, whose diagonal, inverse and values are zero.
[[nodiscard]] constexpr int wholeVectors(int n) noexcept { return (n + 15) & ~15; }

/// The finest level: all open faces weigh 1. Because the unknown is zero in solids and behind walls, neighbours need no
/// mask: the diagonal alone says how many of them count.
struct FineOperator {
  const std::uint8_t* diagonal;
  const std::uint8_t* sixtieths;
  std::ptrdiff_t s;

  /// 60 over the diagonal is whole for all of 1 to 6, so that the inverse fits a byte too.
  static constexpr int kSixty = 60;

  /// At another cell.
  [[nodiscard]] FineOperator from(std::ptrdiff_t at) const noexcept { return {diagonal + at, sixtieths + at, s}; }
};

/// A coarse level: every face has a weight.
struct CoarseOperator {
  const float* x;
  const float* y;
  const float* z;
  const float* diagonal;
  const float* inverseDiagonal;
  std::ptrdiff_t s, p;

  /// At another cell.
  [[nodiscard]] CoarseOperator from(std::ptrdiff_t at) const noexcept {
    return {x + at, y + at, z + at, diagonal + at, inverseDiagonal + at, s, p};
  }
};

/// Weights of one stage of the Chebyshev iteration on Jacobi (Saad 2003, algorithm 12.1), its update written out.
struct ChebyshevStage {
  float own;       ///< weight of the current iterate
  float previous;  ///< weight of the one before
  float jacobi;    ///< weight of (b + neighbours) / diagonal
};

/// Polynomial over the part of the spectrum of Jacobi, from `low` to 2 (no eigenvalue is larger, as the operator is
/// diagonally dominant), that the coarser level cannot see. For the same work it took a quarter fewer iterations than
/// red-black sweeps; and it is symmetric whatever the order of the cells.
template <std::size_t kStages>
constexpr std::array<ChebyshevStage, kStages> chebyshevStages(float low) {
  const float centre = 0.5F * (2.0F + low);
  const float radius = 0.5F * (2.0F - low);
  std::array<ChebyshevStage, kStages> stages{};
  stages[0] = {1.0F - 1.0F / centre, 0.0F, 1.0F / centre};
  float rho = radius / centre;
  for (std::size_t i = 1; i < kStages; ++i) {
    const float next = 1.0F / (2.0F * centre / radius - rho);
    const float momentum = next * rho;
    const float step = 2.0F * next / radius;
    stages[i] = {1.0F + momentum - step, -momentum, step};
    rho = next;
  }
  return stages;
}

}  // namespace grove::objects::fluid::rows
