#include "objects/fluid/backend/solver/pressure/multigrid_kernels.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "each_target.h"
#include "objects/fluid/backend/solver/pressure/pressure_cells.h"

namespace grove::objects::fluid {
namespace {

constexpr int kStages = 4;
constexpr auto kChebyshev = rows::chebyshevStages<kStages>(0.2F);

/// Sweeps of the smoother over a whole level, one stage after the other. The iterate before the first is none.
template <class Neighbours, class Inverse>
void smoothPlainly(const Layout& layout, const Field& b, std::vector<double>& z, const Neighbours& neighbours,
                   const Inverse& inverse) {
  std::vector<double> previous(z.size());
  for (const rows::ChebyshevStage& stage : kChebyshev) {
    std::vector<double> next(z.size());
    forEachCell(layout, [&](std::ptrdiff_t i) {
      const auto k = static_cast<std::size_t>(i);
      next[k] = static_cast<double>(stage.own) * z[k] + static_cast<double>(stage.previous) * previous[k] +
                static_cast<double>(stage.jacobi) * inverse(i) * (static_cast<double>(b[i]) + neighbours(z, i));
    });
    previous = std::exchange(z, next);
  }
}

/// Fails if the sweeps of a V-cycle, on some target, do anything else than whole passes would.
TEST(MultigridKernels, CycleMatchesWholePassesOnEveryTarget) {
  tests::onEachTarget([] {
    std::mt19937 random(8);
    for (const int n : {6, 8, 20, 40}) {
      const CoarseCells cells(n, random);
      const CoarseCells below(n / 2, random);
      const Layout& layout = cells.layout;
      const Field b = cells.noise(random);
      const Field correction = below.noise(random);
      Field z(layout.size());
      Field odd(multigridRoom(layout));
      Field residual(multigridRoom(layout));
      Field coarseB(below.layout.size());
      const CoarseLevel level{layout, cells.a(), b.data(), z.data(), odd.data(), residual.data()};
      const auto neighbours = [&](const std::vector<double>& v, std::ptrdiff_t i) {
        double sum = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
          const std::ptrdiff_t step = layout.step(axis);
          sum += static_cast<double>(cells.weights[axis][i]) * v[static_cast<std::size_t>(i - step)] +
                 static_cast<double>(cells.weights[axis][i + step]) * v[static_cast<std::size_t>(i + step)];
        }
        return sum;
      };
      const auto inverse = [&](std::ptrdiff_t i) { return static_cast<double>(cells.inverse[i]); };
      std::vector<double> plain(layout.size());
      smoothPlainly(layout, b, plain, neighbours, inverse);

      descendCoarse(level, below.layout, below.a(), coarseB.data());
      std::vector<double> left(layout.size());
      forEachCell(layout, [&](std::ptrdiff_t i) {
        const auto k = static_cast<std::size_t>(i);
        ASSERT_NEAR(z[i], plain[k], kTolerance) << n;
        const double d = static_cast<double>(cells.diagonal[i]);
        left[k] = d > 0.0 ? static_cast<double>(b[i]) + neighbours(plain, i) - d * plain[k] : 0.0;
      });
      const std::vector<double> expected = restricted(layout, below, left);
      forEachCell(below.layout, [&](std::ptrdiff_t i) {
        if (below.diagonal[i] > 0.0F) {
          ASSERT_NEAR(coarseB[i], expected[static_cast<std::size_t>(i)], kTolerance) << n;
        }
      });

      ascendCoarse(level, below.layout, below.a(), correction.data());
      for (int zz = 0; zz < n; ++zz) {
        for (int y = 0; y < n; ++y) {
          for (int x = 0; x < n; ++x) {
            const std::ptrdiff_t i = layout.index(x, y, zz);
            if (cells.diagonal[i] <= 0.0F) continue;
            forEachShare(below, x, y, zz, [&](std::ptrdiff_t from, double share) {
              plain[static_cast<std::size_t>(i)] += share * static_cast<double>(correction[from]);
            });
          }
        }
      }
      smoothPlainly(layout, b, plain, neighbours, inverse);
      forEachCell(layout,
                  [&](std::ptrdiff_t i) { ASSERT_NEAR(z[i], plain[static_cast<std::size_t>(i)], kTolerance) << n; });
    }
  });
}

TEST(MultigridKernels, CoarsestSolveMatchesSweepsOnEveryTarget) {
  tests::onEachTarget([] {
    std::mt19937 random(9);
    for (const int n : {3, 4, 7}) {
      const CoarseCells cells(n, random);
      const Layout& layout = cells.layout;
      const Field b = cells.noise(random);
      Field z(layout.size());
      Field odd(multigridRoom(layout));
      Field residual(multigridRoom(layout));
      smoothCoarsest({layout, cells.a(), b.data(), z.data(), odd.data(), residual.data()});
      const auto neighbours = [&](const std::vector<double>& v, std::ptrdiff_t i) {
        double sum = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
          const std::ptrdiff_t step = layout.step(axis);
          sum += static_cast<double>(cells.weights[axis][i]) * v[static_cast<std::size_t>(i - step)] +
                 static_cast<double>(cells.weights[axis][i + step]) * v[static_cast<std::size_t>(i + step)];
        }
        return sum;
      };
      std::vector<double> plain(layout.size());
      for (int sweep = 0; sweep < 6; ++sweep) {
        smoothPlainly(layout, b, plain, neighbours,
                      [&](std::ptrdiff_t i) { return static_cast<double>(cells.inverse[i]); });
      }
      forEachCell(layout,
                  [&](std::ptrdiff_t i) { ASSERT_NEAR(z[i], plain[static_cast<std::size_t>(i)], kTolerance) << n; });
    }
  });
}

}  // namespace
}  // namespace grove::objects::fluid
