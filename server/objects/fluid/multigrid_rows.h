#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "objects/fluid/grid.h"

/// The inner loops of the multigrid, one row of cells at a time. Pointers are to the row's first cell; `s` and `p` are
/// the distances to the next row and plane.
namespace grove::objects::fluid::rows {

/// Cells of the longest row.
inline constexpr int kLongestRow = 128;

/// Rows are worked on in whole vectors: behind a row lie ghosts, whose diagonal, inverse and values are zero.
[[nodiscard]] constexpr int wholeVectors(int n) noexcept { return (n + 15) & ~15; }

/// A row of the unknown, and the same row of the planes below and above.
struct Around3 {
  const float* below;
  const float* here;
  const float* above;
};

/// The finest level: all open faces weigh 1. Because the unknown is zero in solids and behind walls, neighbours need no
/// mask: the diagonal alone tells how many of them count.
struct FineOperator {
  const std::uint8_t* diagonal;
  const std::uint8_t* sixtieths;
  std::ptrdiff_t s;

  /// 60 over the diagonal is whole for all of 1 to 6, so that the inverse fits a byte too.
  static constexpr int kSixty = 60;

  struct Row {
    const std::uint8_t* diagonal;
    const std::uint8_t* sixtieths;
    std::ptrdiff_t s;
    [[nodiscard]] float neighbours(const Around3& z, int i) const noexcept {
      return ((z.here[i - 1] + z.here[i + 1]) + (z.here[i - s] + z.here[i + s])) + (z.below[i] + z.above[i]);
    }
    [[nodiscard]] float weight(int i) const noexcept { return static_cast<float>(diagonal[i]); }
    [[nodiscard]] float inverse(int i) const noexcept {
      return static_cast<float>(sixtieths[i]) * (1.0F / static_cast<float>(kSixty));
    }
  };
  [[nodiscard]] Row row(std::ptrdiff_t at) const noexcept { return {diagonal + at, sixtieths + at, s}; }
};

/// A coarse level: every face has a weight.
struct CoarseOperator {
  const float* x;
  const float* y;
  const float* z;
  const float* diagonal;
  const float* inverseDiagonal;
  std::ptrdiff_t s, p;

  struct Row {
    const float* wx;
    const float* wy;
    const float* wz;
    const float* diagonal;
    const float* inverseDiagonal;
    std::ptrdiff_t s, p;
    [[nodiscard]] float neighbours(const Around3& v, int i) const noexcept {
      return ((wx[i] * v.here[i - 1] + wx[i + 1] * v.here[i + 1]) +
              (wy[i] * v.here[i - s] + wy[i + s] * v.here[i + s])) +
             (wz[i] * v.below[i] + wz[i + p] * v.above[i]);
    }
    [[nodiscard]] float weight(int i) const noexcept { return diagonal[i]; }
    [[nodiscard]] float inverse(int i) const noexcept { return inverseDiagonal[i]; }
  };
  [[nodiscard]] Row row(std::ptrdiff_t at) const noexcept {
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

/// First stage from a zero guess.
template <class Row>
void smoothFromZero(const Row& row, const ChebyshevStage& stage, const float* b, float* __restrict out, int n) {
  const int end = wholeVectors(n);
  for (int i = 0; i < end; ++i) out[i] = stage.jacobi * b[i] * row.inverse(i);
}

/// A stage whose previous iterate does not count.
template <class Row>
void smoothFirst(const Row& row, const ChebyshevStage& stage, const float* b, const Around3& z, float* __restrict out,
                 int n) {
  const int end = wholeVectors(n);
  for (int i = 0; i < end; ++i) {
    out[i] = stage.own * z.here[i] + stage.jacobi * row.inverse(i) * (b[i] + row.neighbours(z, i));
  }
}

/// A stage that replaces the previous iterate in `out` by the next.
template <class Row>
void smooth(const Row& row, const ChebyshevStage& stage, const float* b, const Around3& z, float* __restrict out,
            int n) {
  const int end = wholeVectors(n);
  for (int i = 0; i < end; ++i) {
    out[i] =
        stage.own * z.here[i] + stage.previous * out[i] + stage.jacobi * row.inverse(i) * (b[i] + row.neighbours(z, i));
  }
}

template <class Row>
void residual(const Row& row, const float* b, const Around3& z, float* __restrict out, int n) {
  const int end = wholeVectors(n);
  for (int i = 0; i < end; ++i) {
    const float d = row.weight(i);
    const float r = b[i] + row.neighbours(z, i) - d * z.here[i];
    out[i] = d > 0.0F ? r : 0.0F;
  }
}

/// out = A z, and adds up r.z and z.Az.
template <class Row>
void applyOperator(const Row& row, const float* r, const Around3& z, float* __restrict out, int n, float& rz,
                   float& zaz) {
  const int end = wholeVectors(n);
  float sumRz = 0.0F;
  float sumZaz = 0.0F;
  for (int i = 0; i < end; ++i) {
    const float d = row.weight(i);
    const float a = d > 0.0F ? d * z.here[i] - row.neighbours(z, i) : 0.0F;
    out[i] = a;
    sumRz += r[i] * z.here[i];
    sumZaz += a * z.here[i];
  }
  rz += sumRz;
  zaz += sumZaz;
}

/// Residual rows around a coarse row: row[z][y] for the fine rows 2J-1..2J+2 of the fine planes 2K-1..2K+2.
struct Around {
  const float* row[4][4];
};

/// Transpose of interpolate(). `weights` and `out` are at the coarse row, with its own strides in `weights`.
void restrictRow(const Around& fine, const CoarseOperator::Row& weights, float* out, int coarseCells);

/// Linear interpolation of a coarse row to the fine row on the (highY, highZ) side of it: adds to z where there is air.
template <class Row>
void interpolate(const float* coarse, const CoarseOperator::Row& weights, bool highY, bool highZ, const Row& row,
                 float* z, int coarseCells) {
  const std::ptrdiff_t toY = highY ? weights.s : -weights.s;
  const std::ptrdiff_t toZ = highZ ? weights.p : -weights.p;
  const float* wy = weights.wy + (highY ? weights.s : 0);
  const float* wz = weights.wz + (highZ ? weights.p : 0);
  const float* wx = weights.wx;
  alignas(64) float correction[kLongestRow];
  for (int i = 0; i < coarseCells; ++i) {
    const float c = coarse[i];
    const float base = c + 0.25F * (wy[i] * (coarse[i + toY] - c) + wz[i] * (coarse[i + toZ] - c));
    correction[2 * i] = base + 0.25F * wx[i] * (coarse[i - 1] - c);
    correction[2 * i + 1] = base + 0.25F * wx[i + 1] * (coarse[i + 1] - c);
  }
  for (int i = 0; i < 2 * coarseCells; ++i) z[i] += row.weight(i) > 0.0F ? correction[i] : 0.0F;
}

}  // namespace grove::objects::fluid::rows
