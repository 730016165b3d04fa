#include "objects/fluid/backend/scalable_simulation.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include "objects/fluid/backend/scalable_fire.h"
#include "sanitized.h"

namespace grove::objects::fluid {
namespace {

using ScalableSimulationTest = ScalableFire;

TEST(CellsAtTest, StepsAreOneAndAHalfAndTwo) {
  EXPECT_EQ(cellsAt(64, 0), 64);
  EXPECT_EQ(cellsAt(64, 1), 96);
  EXPECT_EQ(cellsAt(64, 2), 128);
  EXPECT_EQ(cellsAt(24, 1), 40) << "multiples of 8";
  EXPECT_EQ(cellsAt(128, 0), 128);
  EXPECT_EQ(cellsAt(128, 2), 128) << "the finest there is";
}

TEST_F(ScalableSimulationTest, StateIsTransferred) {
  struct Change {
    int from;
    int to;
    double lost;  ///< of the energy, at most: the finer the grid, the smoother is what is on it
  };
  const auto cases = kSanitized ? std::vector<Change>{{32, 48, 0.12}}
                                : std::vector<Change>{{32, 48, 0.12}, {64, 96, 0.04}, {96, 64, 0.03}, {64, 32, 0.05}};
  for (const auto& [from, to, lost] : cases) {
    auto simulation = scalable(from);
    run(simulation.current(), 60);
    const Sums before = sumsOf(simulation.current());
    const auto shown = simulation.current().snapshot(0.0);
    goOver(simulation, to);
    const auto after = simulation.current().snapshot(0.0);
    EXPECT_EQ(after->tick, shown->tick);
    EXPECT_EQ(after->x, shown->x);
    EXPECT_EQ(after->y, shown->y);
    EXPECT_EQ(after->z, shown->z);
    EXPECT_EQ(after->velocityY, shown->velocityY);
    EXPECT_EQ(after->age, shown->age);
    EXPECT_EQ(after->lifetime, shown->lifetime);
    EXPECT_EQ(after->temperature, shown->temperature);
    const Sums now = sumsOf(simulation.current());
    EXPECT_NEAR(now.energy / before.energy, 1.0, lost) << from << " to " << to;
    EXPECT_NEAR(now.heat / before.heat, 1.0, 0.01) << from << " to " << to;
    EXPECT_NEAR(now.height, before.height, 0.02) << from << " to " << to;

    EXPECT_EQ(after->skyLight, shown->skyLight);
    EXPECT_EQ(after->sunLight, shown->sunLight);
  }
}

TEST_F(ScalableSimulationTest, PlumeKeepsRising) {
  std::vector<std::pair<int, int>> cases{{32, 48}, {48, 32}};
  if (!kSanitized) cases.emplace_back(32, 64);
  for (const auto& [from, to] : cases) {
    auto simulation = scalable(from);
    run(simulation.current(), 90);
    auto same = make(from);
    run(*same, 90);
    goOver(simulation, to);
    for (int tick = 0; tick < 15; ++tick) {
      const Sums before = sumsOf(simulation.current());
      const std::uint64_t injected = simulation.current().particles().injected();
      run(simulation.current(), 1);
      const Sums now = sumsOf(simulation.current());
      // What any tick may change, whether it is the first on the new grid or not.
      EXPECT_NEAR(now.energy / before.energy, 1.0, 0.1) << tick;
      EXPECT_NEAR(now.heat / before.heat, 1.0, 0.1) << tick;
      EXPECT_NEAR(now.smoke, before.smoke, 0.06) << tick;
      EXPECT_EQ(simulation.current().particles().injected(), injected + 60U);
      ASSERT_LE(simulation.current().result().residual, 1.0e-4F);
    }
    // Half a second later it is where it would be without the change.
    run(*same, 15);
    const Sums with = sumsOf(simulation.current());
    const Sums without = sumsOf(*same);
    EXPECT_EQ(simulation.current().tick(), same->tick());
    EXPECT_NEAR(with.smoke, without.smoke, 0.1);
    EXPECT_NEAR(with.heat / without.heat, 1.0, 0.2);
  }
}

TEST_F(ScalableSimulationTest, GustsActOnTheNewGrid) {
  auto calm = scalable(32);
  auto blown = scalable(32);
  for (ScalableSimulation* each : {&calm, &blown}) {
    run(each->current(), 45);
    goOver(*each, 48);
  }
  const world::Gust gust{world::Vec3(-1.5F, 0.6F, 2.0F), world::Vec3(1.0F, 0.0F, 0.0F), 6.0F, 9.0F};
  for (int i = 0; i < 10; ++i) {
    calm.current().step(FluidSimulation::kTick, {}, {});
    blown.current().step(FluidSimulation::kTick, {&gust, 1}, {});
  }
  const auto mean = [](const Particles& particles) {
    double sum = 0.0;
    for (const float x : particles.x) sum += static_cast<double>(x);
    return sum / static_cast<double>(particles.count());
  };
  const double way = mean(blown.current().particles()) - mean(calm.current().particles());
  EXPECT_GT(way, 0.15);
}

TEST_F(ScalableSimulationTest, GoingUpAndDownTenTimesLeaksNothing) {
  const auto heldMegabytes = [] {
    long all = 0;
    long resident = 0;
    std::ifstream("/proc/self/statm") >> all >> resident;
    return resident * (::sysconf(_SC_PAGESIZE) / 1024) / 1024;
  };
  auto simulation = scalable(32);
  run(simulation.current(), 30);
  goOver(simulation, 64);
  goOver(simulation, 32);
  const long before = heldMegabytes();
  for (int i = 0; i < 10; ++i) {
    goOver(simulation, 64);
    goOver(simulation, 32);
    run(simulation.current(), 1);
  }
  // One simulation of 64 cells holds more than 20 MB.
  EXPECT_LE(heldMegabytes(), before + 20);
}

TEST_F(ScalableSimulationTest, FailedResizeChangesNothing) {
  int made = 0;
  ScalableSimulation simulation(
      [&](int cells) {
        ++made;
        if (cells == 64) throw std::runtime_error("no room");
        return make(cells);
      },
      16);
  run(simulation.current(), 3);
  simulation.setCells(64);
  const auto untilItFails = [&] {
    while (true) {
      simulation.update();
      std::this_thread::yield();
    }
  };
  EXPECT_THROW(untilItFails(), std::runtime_error);
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(simulation.update());
  EXPECT_EQ(made, 2) << "it does not try again by itself";
  EXPECT_EQ(simulation.current().tick(), 3U);
  goOver(simulation, 24);
  EXPECT_EQ(simulation.current().tick(), 3U);
}

}  // namespace
}  // namespace grove::objects::fluid
