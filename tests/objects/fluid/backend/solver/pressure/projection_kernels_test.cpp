#include "objects/fluid/backend/solver/pressure/projection_kernels.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "each_target.h"
#include "objects/fluid/backend/solver/pressure/pressure_cells.h"

namespace grove::objects::fluid {
namespace {

/// Fails if a target takes another difference, leaves out a row's end, or writes into solids or ghosts.
TEST(ProjectionKernels, ProjectionMatchesScalarOnEveryTarget) {
  tests::onEachTarget([] {
    std::mt19937 random(10);
    for (const int n : {8, 16, 24}) {
      const Cells cells(n, random);
      const Layout& layout = cells.layout;
      Field faces[3] = {randomField(layout.size(), random), randomField(layout.size(), random),
                        randomField(layout.size(), random)};
      Field b(layout.size());
      double squared = 0.0;
      for (int z = 0; z < n; ++z) {
        squared += divergencePlane(layout, z, {faces[0].data(), faces[1].data(), faces[2].data()},
                                   cells.diagonal.data(), b.data());
      }
      double plain = 0.0;
      for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(b.size()); ++i) {
        double flow = 0.0;
        for (int a = 0; a < 3 && cells.diagonal[i] != 0; ++a) {
          flow += static_cast<double>(faces[a][i]) - static_cast<double>(faces[a][i + layout.step(a)]);
        }
        ASSERT_NEAR(b[i], flow, kTolerance) << n;
        plain += flow * flow;
      }
      EXPECT_NEAR(squared, plain, 1.0e-5 * plain);

      const Field pressure = cells.noise(random);
      Field before[3] = {Field(layout.size()), Field(layout.size()), Field(layout.size())};
      for (int a = 0; a < 3; ++a) before[a].copyFrom(faces[a]);
      for (int z = 0; z <= n; ++z) {
        subtractGradientPlane(layout, z, pressure.data(), {faces[0].data(), faces[1].data(), faces[2].data()});
      }
      for (int a = 0; a < 3; ++a) {
        for (int z = -1; z <= n + 1; ++z) {
          for (int y = -1; y <= n + 1; ++y) {
            for (int x = -1; x <= n + 1; ++x) {
              const std::ptrdiff_t i = layout.index(x, y, z);
              const int at[3] = {x, y, z};
              bool isFace = true;
              for (int k = 0; k < 3; ++k) isFace = isFace && at[k] >= 0 && at[k] < n + (k == a ? 1 : 0);
              const float expected = before[a][i] - (isFace ? pressure[i] - pressure[i - layout.step(a)] : 0.0F);
              ASSERT_NEAR(faces[a][i], expected, kTolerance) << n << ' ' << a << ' ' << x << ' ' << y << ' ' << z;
            }
          }
        }
      }
    }
  });
}

TEST(ProjectionKernels, IterationMatchesScalarOnEveryTarget) {
  tests::onEachTarget([] {
    std::mt19937 random(11);
    for (const int n : {8, 16, 24}) {
      const Cells cells(n, random);
      const Layout& layout = cells.layout;
      const Field b = cells.noise(random);
      const Field x = cells.noise(random);
      Field r(layout.size());
      Field divided(layout.size());
      Field ax(layout.size());
      Field masked = randomField(layout.size(), random);
      for (int i = 0; i < n; ++i) {
        residualPlane(layout, i, cells.a(), b.data(), x.data(), r.data());
        divideByDiagonalPlane(layout, i, cells.a(), b.data(), divided.data());
        maskPlane(layout, i, cells.diagonal.data(), masked.data());
      }
      MultigridProducts products;
      for (int z = 0; z < n; ++z) {
        const MultigridProducts plane = applyOperatorPlane(layout, z, cells.a(), b.data(), x.data(), ax.data());
        products.residualDotResult += plane.residualDotResult;
        products.resultDotOperator += plane.resultDotOperator;
      }
      double bx = 0.0;
      double xax = 0.0;
      int kept = 0;
      int air = 0;
      forEachCell(layout, [&](std::ptrdiff_t i) {
        ASSERT_NEAR(r[i], cells.residual(b, x, i), kTolerance);
        ASSERT_NEAR(divided[i], cells.inverse(i) * static_cast<double>(b[i]), kTolerance);
        ASSERT_NEAR(ax[i], static_cast<double>(b[i]) - cells.residual(b, x, i), kTolerance);
        if (cells.diagonal[i] == 0) {
          ASSERT_EQ(masked[i], 0.0F);
        } else {
          kept += masked[i] != 0.0F ? 1 : 0;  // noise is rarely zero
          air += 1;
        }
        bx += static_cast<double>(b[i]) * static_cast<double>(x[i]);
        xax += static_cast<double>(x[i]) * (static_cast<double>(b[i]) - cells.residual(b, x, i));
      });
      EXPECT_GT(kept, air * 99 / 100);
      EXPECT_NEAR(products.residualDotResult, bx, 1.0e-3);
      EXPECT_NEAR(products.resultDotOperator, xax, 1.0e-5 * xax);

      // A step of conjugate gradients, and of red-black relaxation.
      Field p = cells.noise(random);
      Field ap = cells.noise(random);
      Field solution = cells.noise(random);
      Field rest = cells.noise(random);
      Field old[4] = {Field(layout.size()), Field(layout.size()), Field(layout.size()), Field(layout.size())};
      const Field* const now[4] = {&p, &ap, &solution, &rest};
      for (int k = 0; k < 4; ++k) old[k].copyFrom(*now[k]);
      double squared = 0.0;
      for (int z = 0; z < n; ++z) {
        squared += advancePlane(layout, z, 0.3F, 0.7F,
                                {x.data(), b.data(), p.data(), ap.data(), solution.data(), rest.data()});
      }
      double plain = 0.0;
      forEachCell(layout, [&](std::ptrdiff_t i) {
        const float direction = x[i] + 0.7F * old[0][i];
        const float image = b[i] + 0.7F * old[1][i];
        ASSERT_NEAR(p[i], direction, kTolerance);
        ASSERT_NEAR(ap[i], image, kTolerance);
        ASSERT_NEAR(solution[i], old[2][i] + 0.3F * direction, kTolerance);
        ASSERT_NEAR(rest[i], old[3][i] - 0.3F * image, kTolerance);
        plain += static_cast<double>(rest[i]) * static_cast<double>(rest[i]);
      });
      EXPECT_NEAR(squared, plain, 1.0e-5 * plain);

      Field relaxed(layout.size());
      relaxed.copyFrom(x);
      constexpr int kPlane = 2;
      relaxPlane(layout, kPlane, cells.a(), b.data(), 1, 1.5F, relaxed.data());
      for (int y = 0; y < n; ++y) {
        for (int column = 0; column < n; ++column) {
          const std::ptrdiff_t i = layout.index(column, y, kPlane);
          const bool moves = (column + y + kPlane + 1) % 2 == 0 && cells.diagonal[i] != 0;
          const double here = static_cast<double>(x[i]);
          // Neighbours are of the other colour, which stays.
          const double solved = cells.inverse(i) * (static_cast<double>(b[i]) + cells.neighbours(x, i));
          ASSERT_NEAR(relaxed[i], here + (moves ? 1.5 * (solved - here) : 0.0), kTolerance) << column << ' ' << y;
        }
      }
    }
  });
}

}  // namespace
}  // namespace grove::objects::fluid
