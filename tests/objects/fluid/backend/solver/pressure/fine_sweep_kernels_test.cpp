#include "objects/fluid/backend/solver/pressure/fine_sweep_kernels.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "each_target.h"
#include "objects/fluid/backend/solver/pressure/pressure_cells.h"

namespace grove::objects::fluid {
namespace {

/// A field's plane as a FineSweep keeps it.
std::vector<float> keptPlane(const Layout& layout, const Field& field, int z) {
  const KeptPlane kept(layout.cells);
  std::vector<float> plane(static_cast<std::size_t>(kept.size + 64));
  for (int y = 0; y < layout.cells; ++y) {
    for (int x = 0; x < layout.cells; ++x) {
      plane[static_cast<std::size_t>(kept.row(y) + x)] = field[layout.index(x, y, z)];
    }
  }
  return plane;
}

/// Fails if a target leaves out a neighbour, a row's end or a stage, or weighs it otherwise.
TEST(FineSweepKernels, SweepMatchesScalarOnEveryTarget) {
  constexpr auto kChebyshev = rows::chebyshevStages<kFineStages>(0.15F);
  tests::onEachTarget([&] {
    std::mt19937 random(6);
    for (const int n : {8, 16, 24, 40}) {
      const Cells cells(n, random);
      const CoarseCells coarse(n / 2, random);
      const Layout& layout = cells.layout;
      const KeptPlane kept(n);
      const Field b = cells.noise(random);
      const Field x = cells.noise(random);
      const Field error = cells.noise(random);
      const Field before = cells.noise(random);
      const Field coarseValues = coarse.noise(random);
      Field corrected(layout.size());
      Field added(layout.size());
      added.copyFrom(x);
      constexpr int kPlane = 3;
      const std::ptrdiff_t at = layout.index(0, 0, kPlane);
      const std::ptrdiff_t from = coarse.layout.index(0, 0, kPlane / 2);
      const std::vector<float> planes[3] = {keptPlane(layout, error, kPlane - 1), keptPlane(layout, error, kPlane),
                                            keptPlane(layout, error, kPlane + 1)};
      const auto row0 = [&](const std::vector<float>& plane) { return plane.data() + kept.row(0); };
      const auto room = [&] { return std::vector<float>(planes[0].size()); };
      const std::vector<float> source = keptPlane(layout, b, kPlane);
      std::vector<float> residual = room();
      std::vector<float> smoothed = room();
      std::vector<float> left = room();
      std::array<std::vector<float>, kFineStages> out;

      FineStep step;
      step.cells = n;
      step.stride = layout.stride;
      step.correct = {x.data() + at,         corrected.data() + at, cells.a().from(at), coarseValues.data() + from,
                      coarse.a().from(from), kPlane % 2 != 0};
      const float* here = x.data() + at;
      step.residual = {cells.a().from(at),
                       b.data() + at,
                       {here - layout.plane, here, here + layout.plane},
                       residual.data() + kept.row(0),
                       smoothed.data() + kept.row(0)};
      const PlanesAround around{row0(planes[0]), row0(planes[1]), row0(planes[2])};
      for (std::size_t k = 1; k < kFineStages; ++k) {
        out[k] = keptPlane(layout, before, kPlane);
        step.smooth[k] = {cells.sixtieths.data() + at, row0(source), around, out[k].data() + kept.row(0)};
      }
      step.add = {row0(planes[1]), added.data() + at};
      step.left = {cells.a().from(at), row0(source), around, left.data() + kept.row(0)};
      const FineSums sums = runFineStep(step);

      const std::vector<double> correction = interpolated(cells, coarse, coarseValues);
      double squaredResidual = 0.0;
      double squaredB = 0.0;
      double squaredLeft = 0.0;
      for (int y = 0; y < n; ++y) {
        for (int column = 0; column < n; ++column) {
          const std::ptrdiff_t i = layout.index(column, y, kPlane);
          const auto k = static_cast<std::size_t>(kept.row(y) + column);
          ASSERT_NEAR(corrected[i], static_cast<double>(x[i]) + correction[static_cast<std::size_t>(i)], kTolerance);
          const double r = cells.residual(b, x, i);
          ASSERT_NEAR(residual[k], r, kTolerance) << n << ' ' << column << ' ' << y;
          ASSERT_NEAR(smoothed[k], static_cast<double>(kChebyshev[0].jacobi) * cells.inverse(i) * r, kTolerance);
          const double e = static_cast<double>(error[i]);
          for (std::size_t s = 1; s < kFineStages; ++s) {
            const rows::ChebyshevStage& stage = kChebyshev[s];
            const double jacobi = cells.inverse(i) * (static_cast<double>(b[i]) + cells.neighbours(error, i));
            const double old = s == 1 ? 0.0 : static_cast<double>(stage.previous) * static_cast<double>(before[i]);
            ASSERT_NEAR(out[s][k],
                        static_cast<double>(stage.own) * e + old + static_cast<double>(stage.jacobi) * jacobi,
                        kTolerance)
                << n << ' ' << column << ' ' << y << ' ' << s;
          }
          ASSERT_NEAR(added[i], static_cast<double>(x[i]) + e, kTolerance);
          const double rest = cells.residual(b, error, i);
          ASSERT_NEAR(left[k], rest, kTolerance);
          squaredResidual += r * r;
          squaredB += static_cast<double>(b[i]) * static_cast<double>(b[i]);
          squaredLeft += rest * rest;
        }
      }
      EXPECT_NEAR(sums.residual, squaredResidual, 1.0e-5 * squaredResidual);
      EXPECT_NEAR(sums.b, squaredB, 1.0e-5 * squaredB);
      EXPECT_NEAR(sums.left, squaredLeft, 1.0e-5 * squaredLeft);
    }
  });
}

TEST(FineSweepKernels, RestrictionIsTransposedInterpolationOnEveryTarget) {
  tests::onEachTarget([] {
    std::mt19937 random(7);
    for (const int n : {8, 16, 24, 40}) {
      const Cells cells(n, random);
      const CoarseCells coarse(n / 2, random);
      const KeptPlane kept(n);
      const Field values = cells.noise(random);
      std::vector<double> exact(values.size());
      for (std::size_t i = 0; i < exact.size(); ++i) {
        exact[i] = static_cast<double>(values[static_cast<std::ptrdiff_t>(i)]);
      }
      const std::vector<double> expected = restricted(cells.layout, coarse, exact);
      Field out(coarse.layout.size());
      for (int z = 0; z < n / 2; ++z) {
        std::array<std::vector<float>, 4> planes;
        RestrictedPlane plane;
        for (std::size_t dz = 0; dz < 4; ++dz) {
          planes[dz] = keptPlane(cells.layout, values, 2 * z - 1 + static_cast<int>(dz));
          plane.left[dz] = planes[dz].data() + kept.row(0);
        }
        plane.keptStride = kept.stride;
        const std::ptrdiff_t to = coarse.layout.index(0, 0, z);
        plane.weights = coarse.a().from(to);
        plane.out = out.data() + to;
        plane.stride = coarse.layout.stride;
        plane.cells = n / 2;
        restrictFine(plane);
      }
      for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(out.size()); ++i) {
        const bool isCell = coarse.diagonal[i] > 0.0F;
        ASSERT_NEAR(out[i], isCell ? expected[static_cast<std::size_t>(i)] : 0.0, kTolerance) << n << ' ' << i;
      }
    }
  });
}

}  // namespace
}  // namespace grove::objects::fluid
