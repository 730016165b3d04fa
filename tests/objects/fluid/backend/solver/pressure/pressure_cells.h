#pragma once

#include <array>
#include <random>
#include <vector>

#include "objects/fluid/backend/solver/pressure/pressure_operator.h"
#include "objects/fluid/backend/solver/random_fields.h"

namespace grove::objects::fluid {

/// Of values up to about 10, how far targets may be from plain loops.
inline constexpr float kTolerance = 2.0e-5F;

/// Air and solids at random: the diagonal counts a cell's open faces.
struct Cells {
  Cells(int cells, std::mt19937& random) : layout(cells), diagonal(layout.size()), sixtieths(layout.size()) {
    forEachCell(layout, [&](std::ptrdiff_t i) {
      const int faces = static_cast<int>(random() % 7);
      diagonal[i] = static_cast<std::uint8_t>(faces);
      sixtieths[i] = static_cast<std::uint8_t>(faces > 0 ? rows::FineOperator::kSixty / faces : 0);
    });
  }
  [[nodiscard]] rows::FineOperator a() const { return {diagonal.data(), sixtieths.data(), layout.stride}; }
  [[nodiscard]] Field noise(std::mt19937& random) const { return randomCells(layout, diagonal, random); }
  [[nodiscard]] double neighbours(const Field& v, std::ptrdiff_t i) const {
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      sum += static_cast<double>(v[i - layout.step(axis)]) + static_cast<double>(v[i + layout.step(axis)]);
    }
    return sum;
  }
  [[nodiscard]] double residual(const Field& b, const Field& v, std::ptrdiff_t i) const {
    if (diagonal[i] == 0) return 0.0;
    return static_cast<double>(b[i]) + neighbours(v, i) - diagonal[i] * static_cast<double>(v[i]);
  }
  [[nodiscard]] double inverse(std::ptrdiff_t i) const { return diagonal[i] > 0 ? 1.0 / diagonal[i] : 0.0; }

  Layout layout;
  Array<std::uint8_t> diagonal;
  Array<std::uint8_t> sixtieths;
};

/// A coarse level with faces that are open by any share, within the cube.
struct CoarseCells {
  CoarseCells(int cells, std::mt19937& random)
      : layout(cells),
        weights{Field(layout.size()), Field(layout.size()), Field(layout.size())},
        diagonal(layout.size()),
        inverse(layout.size()) {
    for (Field& axis : weights) {
      for (int z = 0; z <= cells; ++z) {
        for (int y = 0; y <= cells; ++y) {
          for (int x = 0; x <= cells; ++x) {
            axis[layout.index(x, y, z)] = static_cast<float>(random() % 5) / 4.0F;
          }
        }
      }
    }
    forEachCell(layout, [&](std::ptrdiff_t i) {
      for (int a = 0; a < 3; ++a) diagonal[i] += weights[a][i] + weights[a][i + layout.step(a)];
      inverse[i] = diagonal[i] > 0.0F ? 1.0F / diagonal[i] : 0.0F;
    });
  }
  [[nodiscard]] rows::CoarseOperator a() const {
    return {weights[0].data(), weights[1].data(), weights[2].data(), diagonal.data(),
            inverse.data(),    layout.step(1),    layout.step(2)};
  }
  [[nodiscard]] Field noise(std::mt19937& random) const {
    const Field noise = randomField(layout.size(), random);
    Field field(layout.size());
    forEachCell(layout, [&](std::ptrdiff_t i) { field[i] = noise[i]; });
    return field;
  }
  [[nodiscard]] double neighbours(const Field& v, std::ptrdiff_t i) const {
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const std::ptrdiff_t step = layout.step(axis);
      sum += static_cast<double>(weights[axis][i]) * static_cast<double>(v[i - step]) +
             static_cast<double>(weights[axis][i + step]) * static_cast<double>(v[i + step]);
    }
    return sum;
  }

  Layout layout;
  Field weights[3];
  Field diagonal;
  Field inverse;
};

/// What the fine cell takes of the coarse ones: along each axis a quarter from the neighbour on its side.
template <class Take>
void forEachShare(const CoarseCells& coarse, int x, int y, int z, const Take& take) {
  const std::ptrdiff_t here = coarse.layout.index(x / 2, y / 2, z / 2);
  double own = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const bool high = (axis == 0 ? x : axis == 1 ? y : z) % 2 != 0;
    const std::ptrdiff_t step = coarse.layout.step(axis);
    const double share = 0.25 * static_cast<double>(coarse.weights[axis][high ? here + step : here]);
    own -= share;
    take(high ? here + step : here - step, share);
  }
  take(here, own);
}

inline std::vector<double> interpolated(const Cells& fine, const CoarseCells& coarse, const Field& values) {
  std::vector<double> result(fine.layout.size());
  const int n = fine.layout.cells;
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const std::ptrdiff_t i = fine.layout.index(x, y, z);
        if (fine.diagonal[i] == 0) continue;
        forEachShare(coarse, x, y, z, [&](std::ptrdiff_t from, double share) {
          result[static_cast<std::size_t>(i)] += share * static_cast<double>(values[from]);
        });
      }
    }
  }
  return result;
}

/// The transpose, times 0.55.
inline std::vector<double> restricted(const Layout& fine, const CoarseCells& coarse,
                                      const std::vector<double>& values) {
  std::vector<double> result(coarse.layout.size());
  const int n = fine.cells;
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        forEachShare(coarse, x, y, z, [&](std::ptrdiff_t to, double share) {
          result[static_cast<std::size_t>(to)] += 0.55 * share * values[static_cast<std::size_t>(fine.index(x, y, z))];
        });
      }
    }
  }
  return result;
}

}  // namespace grove::objects::fluid
