#include "objects/fluid/backend/solver/advection/advection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "objects/fluid/backend/solver/fluid_solver.h"
#include "objects/fluid/backend/solver/ghosts.h"
#include "objects/fluid/backend/solver/kinetic_energy.h"

namespace grove::objects::fluid {
namespace {

constexpr float kPi = 3.14159265F;

FluidSolver::Settings closedBox(int cells) {
  FluidSolver::Settings settings;
  settings.cells = cells;
  settings.size = 1.0F;
  settings.sides = Sides::closed();
  settings.air = {};
  settings.confinement = 0.0F;
  return settings;
}

/// Taylor-Green vortices in a closed box: u = sin x cos y, v = -cos x sin y, which keeps to the walls by itself.
/// Returns the energy after each step; without viscosity, all of its loss is the method's.
std::vector<double> decay(int steps) {
  constexpr int kCells = 32;
  FluidSolver solver(closedBox(kCells));
  const Layout& layout = solver.layout();
  const float k = 2.0F * kPi / kCells;
  for (int z = 0; z < kCells; ++z) {
    for (int y = 0; y <= kCells; ++y) {
      for (int x = 0; x <= kCells; ++x) {
        const float fx = static_cast<float>(x);
        const float fy = static_cast<float>(y);
        const std::ptrdiff_t i = layout.index(x, y, z);
        if (y < kCells) solver.velocity().x[i] = std::sin(k * fx) * std::cos(k * (fy + 0.5F));
        if (x < kCells) solver.velocity().y[i] = -std::cos(k * (fx + 0.5F)) * std::sin(k * fy);
      }
    }
  }
  solver.project();
  std::vector<double> energy{kineticEnergy(layout, solver.velocity())};
  for (int i = 0; i < steps; ++i) {
    solver.advect(0.02F);
    solver.project();
    energy.push_back(kineticEnergy(layout, solver.velocity()));
  }
  return energy;
}

TEST(Advection, TaylorGreenVorticesDecayMonotonicallyAndSlowly) {
  const std::vector<double> energy = decay(50);
  for (std::size_t i = 1; i < energy.size(); ++i) EXPECT_LE(energy[i], energy[i - 1] * (1.0 + 1.0e-5)) << i;
  EXPECT_GT(energy.back(), 0.7 * energy.front());
}

/// A blob that a steady wind carries `cells` cells per step along x.
double centreAfterSteps(float cellsPerStep, int steps, float& lowest, float& highest) {
  constexpr int kCells = 64;
  const Layout layout(kCells);
  Advection advection(layout);
  Velocity wind(layout);
  for (std::size_t i = 0; i < layout.size(); ++i) wind.x[static_cast<std::ptrdiff_t>(i)] = cellsPerStep;
  Field from(layout.size());
  Field to(layout.size());
  for (int z = 16; z < 48; ++z) {
    for (int y = 16; y < 48; ++y) {
      for (int x = 0; x < 40; ++x) {
        const float squared = static_cast<float>((x - 15) * (x - 15) + (y - 32) * (y - 32) + (z - 32) * (z - 32));
        from[layout.index(x, y, z)] = std::exp(-squared / 32.0F);
      }
    }
  }
  for (int i = 0; i < steps; ++i) {
    fillCentreGhosts(layout, Sides::outdoors(), from);
    const Advection::Job job{Place::kCentre, &from, &to};
    advection.advect({&job, 1}, wind, 1.0F, 1.0F);
    std::swap(from, to);
  }
  double sum = 0.0;
  double moment = 0.0;
  lowest = 1.0F;
  highest = 0.0F;
  for (int z = 0; z < kCells; ++z) {
    for (int y = 0; y < kCells; ++y) {
      for (int x = 0; x < kCells; ++x) {
        const float value = from[layout.index(x, y, z)];
        sum += static_cast<double>(value);
        moment += static_cast<double>(value) * (x + 0.5);
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
      }
    }
  }
  return moment / sum;
}

TEST(Advection, MovesByLessAndByMoreThanACell) {
  float lowest = 0.0F;
  float highest = 0.0F;
  EXPECT_NEAR(centreAfterSteps(0.75F, 32, lowest, highest), 15.5 + 24.0, 0.1);
  EXPECT_GE(lowest, 0.0F);
  EXPECT_LE(highest, 1.0F);
  EXPECT_GT(highest, 0.9F);
  EXPECT_NEAR(centreAfterSteps(3.0F, 8, lowest, highest), 15.5 + 24.0, 0.1);
  EXPECT_LE(highest, 1.0F);
}

TEST(Advection, SteadyWindIsExact) {
  // Were it rounded, forces that change the wind by less would do nothing.
  const Layout layout(32);
  Advection advection(layout);
  Velocity wind(layout);
  Velocity next(layout);
  constexpr float kSpeeds[] = {1.00037F, -0.30011F, 0.70003F};
  for (int a = 0; a < 3; ++a) {
    for (std::size_t i = 0; i < layout.size(); ++i) wind.axis(a)[static_cast<std::ptrdiff_t>(i)] = kSpeeds[a];
  }
  const Advection::Job jobs[] = {
      {Place::kFaceX, &wind.x, &next.x}, {Place::kFaceY, &wind.y, &next.y}, {Place::kFaceZ, &wind.z, &next.z}};
  advection.advect(jobs, wind, 0.5F, 1.0F);
  for (int a = 0; a < 3; ++a) {
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) ASSERT_EQ(next.axis(a)[layout.index(x, y, 9)], kSpeeds[a]) << a << ' ' << x;
    }
  }
}

TEST(Advection, StaysFiniteAtExtremeSpeeds) {
  FluidSolver solver(closedBox(16));
  const Layout& layout = solver.layout();
  for (int a = 0; a < 3; ++a) {
    for (int z = 0; z < 16; ++z) {
      for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) {
          solver.velocity().axis(a)[layout.index(x, y, z)] = (x * 13 + y * 7 + z * 3 + a) % 5 < 2 ? 1.0e4F : -1.0e4F;
        }
      }
    }
  }
  solver.project();
  for (int i = 0; i < 5; ++i) {
    solver.advect(0.1F);
    solver.project();
    const double energy = kineticEnergy(layout, solver.velocity());
    ASSERT_TRUE(std::isfinite(energy));
    ASSERT_LT(energy, 1.0e13);
  }
}

TEST(FluidSolver, KeepsMirrorSymmetry) {
  constexpr int kCells = 32;
  FluidSolver::Settings settings = closedBox(kCells);
  settings.size = 4.0F;
  settings.sides = Sides::outdoors();
  settings.air.buoyancy = 7.0F;
  settings.confinement = 0.1F;
  FluidSolver solver(settings);
  std::vector<std::uint8_t> solid;
  for (int z = 0; z < kCells; ++z) {
    for (int y = 0; y < kCells; ++y) {
      for (int x = 0; x < kCells; ++x) {
        solid.push_back(y > 12 && y < 16 && std::abs(2 * x - kCells + 1) < 9 && z > 10 && z < 20 ? 1 : 0);
      }
    }
  }
  solver.solids().setStatic(solid);
  const HeatSource source{{2.0F, 0.2F, 2.0F}, 0.5F, 0.0F};
  for (int i = 0; i < 40; ++i) {
    solver.advect(1.0F / 30.0F);
    solver.force(1.0F / 30.0F, &source, {}, 0.0);
    solver.confine(1.0F / 30.0F);
    solver.project();
  }
  const Layout& layout = solver.layout();
  float fastest = 0.0F;
  float worst = 0.0F;
  for (int z = 0; z < kCells; ++z) {
    for (int y = 0; y < kCells; ++y) {
      for (int x = 0; x < kCells; ++x) {
        const int mirrored = kCells - 1 - x;
        const float v = solver.velocity().y[layout.index(x, y, z)];
        const float u = solver.velocity().x[layout.index(x, y, z)];
        fastest = std::max(fastest, std::fabs(v));
        worst = std::max(worst, std::fabs(v - solver.velocity().y[layout.index(mirrored, y, z)]));
        worst = std::max(worst, std::fabs(u + solver.velocity().x[layout.index(mirrored + 1, y, z)]));
      }
    }
  }
  EXPECT_GT(fastest, 0.8F);
  EXPECT_LT(worst, 0.01F * fastest);
}

}  // namespace
}  // namespace grove::objects::fluid
