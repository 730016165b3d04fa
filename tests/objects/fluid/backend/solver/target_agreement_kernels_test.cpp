#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "each_target.h"
#include "objects/fluid/backend/solver/diagnostics.h"
#include "objects/fluid/backend/solver/fluid_solver.h"

namespace grove::objects::fluid {
namespace {

constexpr int kOddCells = 24;  // not a multiple of the longest vectors
constexpr int kSteps = 50;
constexpr float kOddStep = 1.0F / 30.0F;

/// A fire under a bar, in a wind with whirls.
std::unique_ptr<FluidSolver> burnt() {
  FluidSolver::Settings settings;
  settings.cells = kOddCells;
  settings.size = 3.0F;
  settings.air.wind = {0.4F, 0.0F, -0.2F};
  settings.air.response = 0.5F;
  settings.air.turbulence = 0.8F;
  auto solver = std::make_unique<FluidSolver>(settings);
  std::vector<std::uint8_t> solid;
  for (int z = 0; z < kOddCells; ++z) {
    for (int y = 0; y < kOddCells; ++y) {
      for (int x = 0; x < kOddCells; ++x) solid.push_back(y > 10 && y < 14 && x > 8 && x < 15 ? 1 : 0);
    }
  }
  solver->setStatic(solid);
  const HeatSource source{{1.5F, 0.2F, 1.5F}, 0.4F, 0.5F};
  for (int i = 0; i < kSteps; ++i) {
    solver->advect(kOddStep);
    solver->force(kOddStep, &source, {}, static_cast<double>(i) * static_cast<double>(kOddStep));
    solver->confine(kOddStep);
    const PressureSolver::SolveResult result = solver->project();
    EXPECT_LE(result.residual, 1.0e-4F) << i;
  }
  return solver;
}

float largest(const Layout& layout, const Field& a, const Field* b = nullptr) {
  float max = 0.0F;
  for (int z = 0; z < kOddCells; ++z) {
    for (int y = 0; y < kOddCells; ++y) {
      for (int x = 0; x < kOddCells; ++x) {
        const std::ptrdiff_t i = layout.index(x, y, z);
        max = std::max(max, std::fabs(a[i] - (b != nullptr ? (*b)[i] : 0.0F)));
      }
    }
  }
  return max;
}

/// Replicas on different processors must show the same smoke. Their roundings differ: over these steps they were
/// measured to part by less than 1e-6 of the fastest. One of them may also come to do a cycle of the pressure's more
/// than another, and be better by as much as the solver's tolerance, 1e-4, which is what they are held to. Fails if
/// some kernel computes something else for a target.
TEST(TargetAgreementKernels, FiftyStepsAgreeOnEveryTarget) {
  constexpr float kAgreement = 1.0e-4F;  // of the fastest, or of the hottest
  std::unique_ptr<FluidSolver> first;
  tests::onEachTarget([&] {
    std::unique_ptr<FluidSolver> solver = burnt();
    const Layout& layout = solver->layout();
    EXPECT_LE(relativeResidual(solver->solids(), solver->pressure().pressure(), solver->pressure().rightHandSide()),
              1.05e-4);
    EXPECT_LT(largestNetFlow(solver->solids(), solver->velocity()), 2.0e-4);
    if (first == nullptr) {
      first = std::move(solver);
      return;
    }
    const float fastest = std::max({largest(layout, first->velocity().x), largest(layout, first->velocity().y),
                                    largest(layout, first->velocity().z)});
    EXPECT_GT(fastest, 0.8F);
    for (int a = 0; a < 3; ++a) {
      EXPECT_LT(largest(layout, first->velocity().axis(a), &solver->velocity().axis(a)), kAgreement * fastest) << a;
    }
    const float hottest = largest(layout, first->temperature());
    EXPECT_GT(hottest, 0.3F);
    EXPECT_LT(largest(layout, first->temperature(), &solver->temperature()), kAgreement * hottest);
  });
}

}  // namespace
}  // namespace grove::objects::fluid
