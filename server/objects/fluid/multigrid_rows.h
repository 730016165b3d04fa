#pragma once

#include <cstddef>
#include <cstdint>

#include "objects/fluid/grid.h"

/// The inner loops of the multigrid, one row of cells at a time. Pointers are to the row's first cell; `s` and `p` are
/// the distances to the next row and plane.
namespace grove::objects::fluid::rows {

/// 1, 0, 1, 0, ... : picks the cells of one colour out of a row.
struct Checkerboard {
  static constexpr int kLongest = 128;
  float values[kLongest + 16];
  constexpr Checkerboard() : values() {
    for (int i = 0; i < kLongest + 16; ++i) values[i] = i % 2 == 0 ? 1.0F : 0.0F;
  }
  /// Colour 0 is the cells with even x + y + z.
  [[nodiscard]] const float* colour(int c, int y, int z) const noexcept { return values + ((c + y + z) & 1); }
};
inline constexpr Checkerboard kCheckerboard;

/// The finest level: all open faces weigh 1. Because the unknown is zero in solids and behind walls, neighbours need no
/// mask: the diagonal alone tells how many of them count.
struct FineOperator {
  const std::uint8_t* diagonal;
  std::ptrdiff_t s, p;

  struct Row {
    const std::uint8_t* diagonal;
    std::ptrdiff_t s, p;
    [[nodiscard]] float neighbours(const float* z, int i) const noexcept {
      return ((z[i - 1] + z[i + 1]) + (z[i - s] + z[i + s])) + (z[i - p] + z[i + p]);
    }
    [[nodiscard]] float weight(int i) const noexcept { return static_cast<float>(diagonal[i]); }
    [[nodiscard]] float inverse(int i) const noexcept {
      const float d = static_cast<float>(diagonal[i]);
      return d > 0.0F ? 1.0F / d : 0.0F;
    }
  };
  [[nodiscard]] Row row(std::ptrdiff_t at) const noexcept { return {diagonal + at, s, p}; }
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
    [[nodiscard]] float neighbours(const float* z, int i) const noexcept {
      return ((wx[i] * z[i - 1] + wx[i + 1] * z[i + 1]) + (wy[i] * z[i - s] + wy[i + s] * z[i + s])) +
             (wz[i] * z[i - p] + wz[i + p] * z[i + p]);
    }
    [[nodiscard]] float weight(int i) const noexcept { return diagonal[i]; }
    [[nodiscard]] float inverse(int i) const noexcept { return inverseDiagonal[i]; }
  };
  [[nodiscard]] Row row(std::ptrdiff_t at) const noexcept {
    return {x + at, y + at, z + at, diagonal + at, inverseDiagonal + at, s, p};
  }
};

/// First half-sweep from a zero guess: one colour of z = b / diagonal, the other zero.
template <class Row>
void smoothFromZero(const Row& row, const float* __restrict b, float* __restrict z, const float* colour, int n) {
  for (int i = 0; i < n; ++i) z[i] = colour[i] * b[i] * row.inverse(i);
}

/// Gauss-Seidel half-sweep of one colour. The row is staged, since loads that overlap the last store by a part of a
/// vector would stall; cells of the other colour keep their value, so their order does not matter.
template <class Row>
void smooth(const Row& row, const float* b, float* z, const float* colour, int n) {
  alignas(64) float staged[Checkerboard::kLongest];
  for (int i = 0; i < n; ++i) {
    const float better = (b[i] + row.neighbours(z, i)) * row.inverse(i);
    staged[i] = z[i] + colour[i] * (better - z[i]);
  }
  for (int i = 0; i < n; ++i) z[i] = staged[i];
}

template <class Row>
void residual(const Row& row, const float* b, const float* z, float* __restrict out, int n) {
  for (int i = 0; i < n; ++i) {
    const float d = row.weight(i);
    const float r = b[i] + row.neighbours(z, i) - d * z[i];
    out[i] = d > 0.0F ? r : 0.0F;
  }
}

/// out = A z, and adds up r.z and z.Az.
template <class Row>
void applyOperator(const Row& row, const float* r, const float* z, float* __restrict out, int n, float& rz,
                   float& zaz) {
  float sumRz = 0.0F;
  float sumZaz = 0.0F;
  for (int i = 0; i < n; ++i) {
    const float d = row.weight(i);
    const float a = d > 0.0F ? d * z[i] - row.neighbours(z, i) : 0.0F;
    out[i] = a;
    sumRz += r[i] * z[i];
    sumZaz += a * z[i];
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
  alignas(64) float correction[Checkerboard::kLongest];
  for (int i = 0; i < coarseCells; ++i) {
    const float c = coarse[i];
    const float base = c + 0.25F * (wy[i] * (coarse[i + toY] - c) + wz[i] * (coarse[i + toZ] - c));
    correction[2 * i] = base + 0.25F * wx[i] * (coarse[i - 1] - c);
    correction[2 * i + 1] = base + 0.25F * wx[i + 1] * (coarse[i + 1] - c);
  }
  for (int i = 0; i < 2 * coarseCells; ++i) z[i] += row.weight(i) > 0.0F ? correction[i] : 0.0F;
}

}  // namespace grove::objects::fluid::rows
