#include "objects/fluid/backend/solver/pressure/pressure_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "objects/fluid/backend/solver/diagnostics.h"
#include "objects/fluid/backend/solver/pressure/conjugate_gradients.h"
#include "objects/fluid/backend/solver/pressure/red_black.h"

namespace grove::objects::fluid {
namespace {

using IsSolid = std::function<bool(int, int, int)>;

std::vector<std::uint8_t> cellsWhere(int n, const IsSolid& isSolid) {
  std::vector<std::uint8_t> solid;
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) solid.push_back(isSolid(x, y, z) ? 1 : 0);
    }
  }
  return solid;
}

void fillWithNoise(const Layout& layout, Velocity& velocity) {
  std::minstd_rand random(7);
  for (int a = 0; a < 3; ++a) {
    for (int z = 0; z <= layout.cells; ++z) {
      for (int y = 0; y <= layout.cells; ++y) {
        for (int x = 0; x <= layout.cells; ++x) {
          const float noise = static_cast<float>(random() % 2001) / 1000.0F - 1.0F;
          velocity.axis(a)[layout.index(x, y, z)] = noise + std::sin(0.1F * static_cast<float>(x + a * y));
        }
      }
    }
  }
}

struct Case {
  const char* name;
  Sides sides;
  IsSolid isSolid;
};

class Projection : public testing::TestWithParam<Case> {};

TEST_P(Projection, IsDivergenceFreeAndRespectsSolids) {
  constexpr int kCells = 32;
  const Layout layout(kCells);
  SolidGrid solids(layout, GetParam().sides);
  solids.setStatic(cellsWhere(kCells, GetParam().isSolid));
  Velocity velocity(layout);
  fillWithNoise(layout, velocity);
  solids.enforce(velocity);
  const double before = largestNetFlow(solids, velocity);

  PressureSolver solver(layout);
  const PressureSolver::SolveResult result = solver.project(solids, velocity, {1.0e-4F, 60});

  EXPECT_LE(result.residual, 1.0e-4F);
  const double residual = relativeResidual(solids, solver.pressure(), solver.rightHandSide());
  EXPECT_LE(residual, 1.05e-4);
  EXPECT_NEAR(static_cast<double>(result.residual), residual, 0.1 * residual);
  EXPECT_GT(before, 1.0);
  EXPECT_LT(largestNetFlow(solids, velocity), 2.0e-3 * before);
  for (int a = 0; a < 3; ++a) {
    for (int z = 0; z < kCells; ++z) {
      for (int y = 0; y < kCells; ++y) {
        for (int x = 0; x < kCells; ++x) {
          const std::ptrdiff_t i = layout.index(x, y, z);
          if (solids.air()[i] == 0 || solids.air()[i - layout.step(a)] == 0) {
            ASSERT_EQ(velocity.axis(a)[i], 0.0F) << x << ' ' << y << ' ' << z;
          }
        }
      }
    }
  }
}

bool never(int, int, int) { return false; }
bool ball(int x, int y, int z) { return (x - 16) * (x - 16) + (y - 14) * (y - 14) + (z - 15) * (z - 15) < 40; }
bool oneCellWall(int x, int y, int) { return x == 17 && y < 26; }
/// A shell of one cell: the air inside has no way out.
bool shell(int x, int y, int z) {
  const int far = std::max({std::abs(x - 15), std::abs(y - 15), std::abs(z - 15)});
  return far == 6;
}
bool rubble(int x, int y, int z) { return (x * 7919 + y * 104729 + z * 1299709) % 7 == 0; }

INSTANTIATE_TEST_SUITE_P(
    Scenes, Projection,
    testing::Values(Case{"Outdoors", Sides::outdoors(), never}, Case{"ClosedBox", Sides::closed(), never},
                    Case{"Ball", Sides::outdoors(), ball}, Case{"OneCellWall", Sides::outdoors(), oneCellWall},
                    Case{"WallDividesClosedBox", Sides::closed(), [](int x, int, int) { return x == 17; }},
                    Case{"Shell", Sides::outdoors(), shell}, Case{"Rubble", Sides::outdoors(), rubble}),
    [](const auto& scene) { return std::string(scene.param.name); });

TEST(PressureSolver, FindsTheCosineModeOfAClosedBox) {
  constexpr int kCells = 48;
  const Layout layout(kCells);
  SolidGrid solids(layout, Sides::closed());
  Field b(layout.size());
  Field expected(layout.size());
  const int sweeps[3] = {1, 2, 3};
  double eigenvalue = 0.0;
  for (const int w : sweeps) eigenvalue += 2.0 - 2.0 * std::cos(M_PI * w / kCells);
  for (int z = 0; z < kCells; ++z) {
    for (int y = 0; y < kCells; ++y) {
      for (int x = 0; x < kCells; ++x) {
        const double mode = std::cos(M_PI * sweeps[0] * (x + 0.5) / kCells) *
                            std::cos(M_PI * sweeps[1] * (y + 0.5) / kCells) *
                            std::cos(M_PI * sweeps[2] * (z + 0.5) / kCells);
        expected[layout.index(x, y, z)] = static_cast<float>(mode);
        // A constant, which no pressure can meet, must be projected out.
        b[layout.index(x, y, z)] = static_cast<float>(mode * eigenvalue) + 0.01F;
      }
    }
  }
  PressureSolver solver(layout);
  const PressureSolver::SolveResult result = solver.solve(solids, b, {1.0e-5F, 60});
  EXPECT_LE(result.residual, 1.0e-5F);

  double mean = 0.0;
  for (std::size_t i = 0; i < layout.size(); ++i) {
    mean += static_cast<double>(solver.pressure()[static_cast<std::ptrdiff_t>(i)]);
  }
  mean /= kCells * kCells * kCells;
  double worst = 0.0;
  for (int z = 0; z < kCells; ++z) {
    for (int y = 0; y < kCells; ++y) {
      for (int x = 0; x < kCells; ++x) {
        const std::ptrdiff_t i = layout.index(x, y, z);
        worst = std::max(
            worst, std::fabs(static_cast<double>(solver.pressure()[i]) - mean - static_cast<double>(expected[i])));
      }
    }
  }
  EXPECT_LT(worst, 2.0e-3);
}

TEST(PressureSolver, ConvergesQuicklyAndMonotonically) {
  constexpr int kCells = 64;
  const Layout layout(kCells);
  SolidGrid solids(layout, Sides::outdoors());
  solids.setStatic(cellsWhere(kCells, [](int x, int y, int z) { return y < 20 && (x / 8 + z / 8) % 3 == 0; }));
  float last = 1.0F;
  for (int iterations = 1; iterations <= 8; ++iterations) {
    Velocity velocity(layout);
    fillWithNoise(layout, velocity);
    solids.enforce(velocity);
    PressureSolver solver(layout);
    // A new solver has to take over all solids.
    SolidGrid own(layout, Sides::outdoors());
    own.setStatic(cellsWhere(kCells, [](int x, int y, int z) { return y < 20 && (x / 8 + z / 8) % 3 == 0; }));
    const float residual = solver.project(own, velocity, {0.0F, iterations}).residual;
    EXPECT_LT(residual, last);
    last = residual;
  }
  EXPECT_LT(last, 1.0e-4F);
}

TEST(PressureSolver, CyclesConvergeBelowHalfPrecision) {
  // The smoother computes in 11 bits; the residual that it works on must not.
  const Layout layout(64);
  SolidGrid solids(layout, Sides::outdoors());
  solids.setStatic(cellsWhere(64, [](int x, int y, int z) { return y < 20 && (x / 8 + z / 8) % 3 == 0; }));
  Velocity velocity(layout);
  fillWithNoise(layout, velocity);
  solids.enforce(velocity);
  PressureSolver solver(layout);
  const PressureSolver::SolveResult result = solver.project(solids, velocity, {3.0e-6F, 60});
  EXPECT_LE(relativeResidual(solids, solver.pressure(), solver.rightHandSide()), 4.0e-6);
  EXPECT_LE(result.iterations, 5);
}

TEST(PressureSolver, StartsFromTheLastPressure) {
  const Layout layout(32);
  SolidGrid solids(layout, Sides::outdoors());
  PressureSolver solver(layout);
  Velocity velocity(layout);
  fillWithNoise(layout, velocity);
  solids.enforce(velocity);
  const int first = solver.project(solids, velocity, {1.0e-4F, 60}).iterations;
  fillWithNoise(layout, velocity);
  solids.enforce(velocity);
  EXPECT_GT(first, 1);
  EXPECT_LE(solver.project(solids, velocity, {1.0e-4F, 60}).iterations, 1);
}

TEST(OtherSolvers, AgreeWithMultigrid) {
  constexpr int kCells = 32;
  const Layout layout(kCells);
  SolidGrid solids(layout, Sides::outdoors());
  solids.setStatic(cellsWhere(kCells, oneCellWall));
  Field b(layout.size());
  for (int z = 0; z < kCells; ++z) {
    for (int y = 0; y < kCells; ++y) {
      for (int x = 0; x < kCells; ++x) {
        b[layout.index(x, y, z)] = std::sin(0.3F * static_cast<float>(x + 2 * y)) + (x == 9 && z == 12 ? 1.0F : 0.0F);
      }
    }
  }
  PressureSolver ours(layout);
  ours.solve(solids, b, {1.0e-5F, 60});
  Multigrid multigrid(layout);
  multigrid.rebuild(solids, CellBox::whole(kCells));
  const rows::FineOperator a = multigrid.finest();
  const auto worst = [&](const Field& x) {
    double largest = 0.0;
    double difference = 0.0;
    for (std::size_t i = 0; i < layout.size(); ++i) {
      const auto at = static_cast<std::ptrdiff_t>(i);
      largest = std::max(largest, static_cast<double>(std::fabs(x[at])));
      difference = std::max(difference, static_cast<double>(std::fabs(x[at] - ours.pressure()[at])));
    }
    return difference / largest;
  };

  Field x(layout.size());
  ConjugateGradients gradients(layout);
  int iterations = 0;
  const auto diagonal = [&](const Field& r, Field& z, Field& az) { return applyDiagonal(layout, a, r, z, az); };
  gradients.solve(a, Pockets(), diagonal, b, x, 0.0, 200, iterations);
  EXPECT_LE(relativeResidual(solids, x, b), 2.0e-5);
  EXPECT_LT(worst(x), 1.0e-3);

  x.clear();
  double last = 1.0;
  for (int i = 0; i < 10; ++i) {
    for (int sweep = 0; sweep < 20; ++sweep) sweepRedBlack(layout, a, b, x);
    const double residual = relativeResidual(solids, x, b);
    EXPECT_LT(residual, std::max(0.7 * last, 1.0e-5)) << i;
    last = residual;
  }
  EXPECT_LT(worst(x), 1.0e-3);
}

TEST(PressureSolver, FollowsMovingSolids) {
  // Updating only where solids moved must give what building anew gives.
  const Layout layout(32);
  SolidGrid moving(layout, Sides::outdoors());
  PressureSolver solver(layout);
  for (int i = 0; i < 5; ++i) {
    const Capsule capsule{{1.0F + 0.3F * static_cast<float>(i), 0.0F, 2.0F}, 1.8F, 0.4F, {1.0F, 0.0F, 0.0F}};
    moving.setMovers({&capsule, 1}, 0.125F);
    Velocity velocity(layout);
    fillWithNoise(layout, velocity);
    moving.enforce(velocity);
    solver.forget();
    const float updated = solver.project(moving, velocity, {0.0F, 4}).residual;

    SolidGrid fresh(layout, Sides::outdoors());
    fresh.setMovers({&capsule, 1}, 0.125F);
    fillWithNoise(layout, velocity);
    fresh.enforce(velocity);
    PressureSolver other(layout);
    EXPECT_FLOAT_EQ(updated, other.project(fresh, velocity, {0.0F, 4}).residual);
    EXPECT_GT(moving.solidCells(), 20);
  }
}

}  // namespace
}  // namespace grove::objects::fluid
