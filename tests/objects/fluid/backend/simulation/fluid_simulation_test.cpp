#include "objects/fluid/backend/simulation/fluid_simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "objects/fluid/backend/solver/diagnostics.h"
#include "objects/fluid/backend/solver/kinetic_energy.h"
#include "world/rays/ray_obstacles.h"
#include "world/sky.h"

namespace grove::objects::fluid {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class FluidSimulationTest : public testing::Test {
 protected:
  static FluidSettings settings() {
    FluidSettings result;
    result.grid = 32;
    result.size = 6.0F;
    return result;
  }
  static void run(FluidSimulation& simulation, int ticks) {
    for (int i = 0; i < ticks; ++i) simulation.step(FluidSimulation::kTick, {}, {});
  }
  static world::Vec3 meanPlace(const FluidSnapshot& snapshot) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < snapshot.count(); ++i) sum += glm::dvec3(snapshot.x[i], snapshot.y[i], snapshot.z[i]);
    return world::Vec3(sum / static_cast<double>(snapshot.count()));
  }
  static bool finite(const FluidSnapshot& s) {
    for (const std::vector<float>* values :
         {&s.x, &s.y, &s.z, &s.velocityX, &s.velocityY, &s.velocityZ, &s.skyLight, &s.sunLight, &s.temperature}) {
      for (const float value : *values) {
        if (!std::isfinite(value)) return false;
      }
    }
    return true;
  }

  const world::RayScene noSurfaces_{world::Triangles{}};
  const world::RayObstacles nothing_{noSurfaces_, noSurfaces_};
};

TEST_F(FluidSimulationTest, SmokeRisesFromTheFireInWorldCoordinates) {
  const world::Vec3 position(10.0F, 2.0F, -5.0F);
  FluidSimulation simulation(settings(), position, nothing_, world::Sky());
  run(simulation, 90);
  const auto snapshot = simulation.snapshot(12.5);
  EXPECT_EQ(snapshot->time, 12.5);
  EXPECT_EQ(snapshot->tick, 90U);
  ASSERT_GT(snapshot->count(), 3000U);
  EXPECT_TRUE(finite(*snapshot));
  const world::Vec3 mean = meanPlace(*snapshot);
  EXPECT_GT(mean.y, 2.8F);
  EXPECT_NEAR(mean.x, 10.0F, 1.5F);
  EXPECT_NEAR(mean.z, -5.0F, 1.5F);
  float flame = 0.0F;
  for (std::size_t i = 0; i < snapshot->count(); ++i) {
    ASSERT_GE(snapshot->y[i], 2.0F);
    ASSERT_LE(snapshot->y[i], 8.0F);
    ASSERT_LT(snapshot->age[i], snapshot->lifetime[i]);
    if (snapshot->temperature[i] > 0.5F) flame = std::max(flame, snapshot->y[i] - 2.0F);
  }
  EXPECT_GT(flame, 0.4F);
  EXPECT_LT(flame, 1.8F);
}

TEST_F(FluidSimulationTest, IsDeterministic) {
  FluidSimulation a(settings(), {}, nothing_, world::Sky());
  FluidSimulation b(settings(), {}, nothing_, world::Sky());
  run(a, 40);
  run(b, 40);
  EXPECT_EQ(a.snapshot(0.0)->x, b.snapshot(0.0)->x);
  EXPECT_EQ(a.snapshot(0.0)->sunLight, b.snapshot(0.0)->sunLight);
}

/// A copy of a world begins where the first one did.
TEST_F(FluidSimulationTest, ResumesFromAState) {
  FluidSimulation first(settings(), {}, nothing_, world::Sky());
  run(first, 40);
  const FluidState state = first.state();
  FluidSimulation second(settings(), {}, nothing_, world::Sky());
  second.takeOver(state);
  EXPECT_EQ(second.tick(), 40U);
  EXPECT_EQ(second.snapshot(0.0)->x, first.snapshot(0.0)->x);
  run(first, 10);
  run(second, 10);
  const auto ofFirst = first.snapshot(0.0);
  const auto ofSecond = second.snapshot(0.0);
  ASSERT_EQ(ofSecond->count(), ofFirst->count()) << "the same particles are born and die";
  // The pressure, which is solved to a tolerance, began at another guess.
  EXPECT_LT(glm::length(meanPlace(*ofSecond) - meanPlace(*ofFirst)), 0.002F);
}

TEST_F(FluidSimulationTest, GustsMoveSmoke) {
  for (const world::Vec3 direction : {world::Vec3(1.0F, 0.0F, 0.0F), world::Vec3(0.0F, 0.0F, -1.0F)}) {
    FluidSimulation calm(settings(), {}, nothing_, world::Sky());
    FluidSimulation blown(settings(), {}, nothing_, world::Sky());
    run(calm, 60);
    run(blown, 60);
    const world::Gust gust{world::Vec3(0.0F, 0.6F, 0.0F) - 2.5F * direction, direction, 6.0F, 9.0F};
    for (int i = 0; i < 10; ++i) {
      calm.step(FluidSimulation::kTick, {}, {});
      blown.step(FluidSimulation::kTick, {&gust, 1}, {});
    }
    const world::Vec3 way = meanPlace(*blown.snapshot(0.0)) - meanPlace(*calm.snapshot(0.0));
    EXPECT_GT(glm::dot(way, direction), 0.15F);
    EXPECT_GT(glm::dot(way, direction), 0.7F * glm::length(way));
  }
}

/// Would catch a peer who has thousands blow, which took seconds of each tick.
TEST_F(FluidSimulationTest, OnlyTheNearestGustsCount) {
  std::vector<world::Gust> near;
  std::vector<world::Gust> all;
  for (std::size_t i = 0; i < 1000; ++i) {
    const float away = i < FluidSimulation::kMaxGusts ? 0.5F : 1.0F + 0.01F * static_cast<float>(i);
    const world::Gust gust{{3.0F + away, 1.0F, 0.001F * static_cast<float>(i)}, {-1.0F, 0.0F, 0.0F}, 8.0F, 60.0F, i};
    all.push_back(gust);
    if (i < FluidSimulation::kMaxGusts) near.push_back(gust);
  }
  std::ranges::reverse(near);
  std::ranges::reverse(all);
  FluidSimulation few(settings(), {}, nothing_, world::Sky());
  FluidSimulation many(settings(), {}, nothing_, world::Sky());
  run(few, 10);
  run(many, 10);
  for (int i = 0; i < 5; ++i) {
    few.step(FluidSimulation::kTick, near, {});
    many.step(FluidSimulation::kTick, all, {});
  }
  run(few, 10);
  run(many, 10);
  EXPECT_EQ(few.snapshot(0.0)->x, many.snapshot(0.0)->x);
}

TEST_F(FluidSimulationTest, WalkersPushAirAndExcludeSmoke) {
  FluidSettings still = settings();
  still.wind = world::Vec3(0.0F);
  still.turbulence = 0.0F;
  FluidSimulation simulation(still, {}, nothing_, world::Sky());
  run(simulation, 60);
  world::Player player;
  player.velocity = {2.0F, 0.0F, 0.0F};
  for (int i = 0; i < 30; ++i) {
    player.pose.position = {-1.0F + 2.0F * FluidSimulation::kTick * static_cast<float>(i), world::kEyeHeight, 0.0F};
    simulation.step(FluidSimulation::kTick, {}, {&player, 1});
    const auto& solver = simulation.solver();
    ASSERT_LE(relativeResidual(solver.solids(), solver.pressure().pressure(), solver.pressure().rightHandSide()),
              1.2e-4);
    const auto snapshot = simulation.snapshot(0.0);
    for (std::size_t k = 0; k < snapshot->count(); ++k) {
      const float cell = solver.cellSize();
      const std::ptrdiff_t at = solver.layout().index(static_cast<int>((snapshot->x[k] + 3.0F) / cell),
                                                      static_cast<int>(snapshot->y[k] / cell),
                                                      static_cast<int>((snapshot->z[k] + 3.0F) / cell));
      ASSERT_NE(solver.solids().air()[at], 0);
    }
  }
  // The air in front of the chest goes along, on the whole by a good part of the walker's speed.
  const auto& solver = simulation.solver();
  const int x = static_cast<int>((player.pose.position.x + 0.5F + 3.0F) / solver.cellSize());
  EXPECT_GT(solver.velocity().x[solver.layout().index(x, 6, 16)], 0.3F);
}

TEST_F(FluidSimulationTest, BadInputIsRefusedOrClamped) {
  FluidSimulation simulation(settings(), {}, nothing_, world::Sky());
  run(simulation, 20);
  for (const float seconds : {kNan, -1.0F, 0.0F, std::numeric_limits<float>::infinity()}) {
    simulation.step(seconds, {}, {});
  }
  EXPECT_EQ(simulation.tick(), 20U);

  const world::Gust gusts[] = {
      {{kNan, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, 6.0F, 9.0F}, {{0.0F, 1.0F, 0.0F}, {kNan, 0.0F, 0.0F}, 6.0F, 9.0F},
      {{0.0F, 1.0F, 0.0F}, {0.0F, 0.0F, 0.0F}, 6.0F, 9.0F}, {{0.0F, 1.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, 1.0e30F, 1.0e30F},
      {{0.0F, 1.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, kNan, 9.0F}, {{1.0e30F, 1.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, 6.0F, 9.0F}};
  world::Player players[3];
  players[0].pose.position = {kNan, 0.0F, 0.0F};
  players[1].velocity = {1.0e30F, 0.0F, 0.0F};
  players[1].pose.position = {0.3F, world::kEyeHeight, 0.0F};
  players[2].pose.position = {1.0e30F, 1.0F, 1.0e30F};
  for (int i = 0; i < 10; ++i) simulation.step(100.0F, gusts, players);
  EXPECT_EQ(simulation.tick(), 30U);
  const auto& solver = simulation.solver();
  EXPECT_TRUE(std::isfinite(kineticEnergy(solver.layout(), solver.velocity())));
  EXPECT_TRUE(finite(*simulation.snapshot(0.0)));
  simulation.step(FluidSimulation::kTick, {}, {});
  EXPECT_LE(simulation.result().residual, 1.0e-4F);
}

TEST_F(FluidSimulationTest, ReportsItsMemory) {
  const world::RayScene noSurfaces(world::Triangles{});
  const world::RayObstacles nothing(noSurfaces, noSurfaces);
  FluidSettings coarse = settings();
  FluidSettings fine = settings();
  coarse.grid = 16;
  fine.grid = 64;
  const FluidSimulation small(coarse, world::Vec3(0.0F), nothing, world::Sky());
  const FluidSimulation large(fine, world::Vec3(0.0F), nothing, world::Sky());
  // Velocity and temperature, now and next, and what the pressure needs are more than a dozen fields.
  EXPECT_GT(large.bytes(), 12 * sizeof(float) * 64 * 64 * 64);
  EXPECT_LT(large.bytes(), 80 * sizeof(float) * 64 * 64 * 64);
  EXPECT_GT(large.bytes(), 8 * small.bytes());
}

}  // namespace
}  // namespace grove::objects::fluid
