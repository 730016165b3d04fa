#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "objects/fluid/backend/solver/grid.h"

/// Data of the multigrid's inner loops. `s` and `p` are the offsets of the next row and plane.
namespace grove::objects::fluid::rows {

/// Cells of the longest row.
inline constexpr int kLongestRow = 128;

/// Loops process whole vectors: ghosts follow each row, and their diagonal, inverse and values are zero.
[[nodiscard]] constexpr int wholeVectors(int n) noexcept { return (n + 15) & ~15; }

/// The finest level: all open faces have weight 1. The unknown is zero in solids and behind walls, so neighbours need
/// no mask: the diagonal alone holds the number of open faces.
struct FineOperator {
  const std::uint8_t* diagonal;
  const std::uint8_t* sixtieths;
  std::ptrdiff_t s;

  /// 60 / diagonal is an integer for 1 to 6, so the inverse also fits a byte.
  static constexpr int kSixty = 60;

  /// The operator at an offset.
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

  /// The operator at an offset.
  [[nodiscard]] CoarseOperator from(std::ptrdiff_t at) const noexcept {
    return {x + at, y + at, z + at, diagonal + at, inverseDiagonal + at, s, p};
  }
};

/// Weights of one stage of the Chebyshev iteration on Jacobi (Saad 2003, algorithm 12.1), in expanded form.
struct ChebyshevStage {
  float own;       ///< weight of the current iterate
  float previous;  ///< weight of the previous iterate
  float jacobi;    ///< weight of (b + neighbours) / diagonal
};

/// Polynomial over the part of Jacobi's spectrum that the coarser level cannot reduce, from `low` to 2 (the upper
/// bound, because the operator is diagonally dominant). For equal work it took a quarter fewer iterations than
/// red-black sweeps, and it is symmetric for any order of the cells.
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
