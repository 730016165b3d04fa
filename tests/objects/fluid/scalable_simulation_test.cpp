#include "objects/fluid/scalable_simulation.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include "objects/fluid/diagnostics.h"

namespace grove::objects::fluid {
namespace {

constexpr float kTick = FluidSimulation::kTick;
constexpr int kGrid = 32;  // of the scene

class ScalableSimulationTest : public testing::Test {
 protected:
  [[nodiscard]] std::unique_ptr<FluidSimulation> make(int cells) const {
    FluidSettings settings;
    settings.grid = kGrid;
    settings.size = 6.0F;
    return std::make_unique<FluidSimulation>(settings, world::Vec3(1.0F, 0.0F, 2.0F), nothing_, nothing_, cells);
  }
  [[nodiscard]] ScalableSimulation scalable(int cells) const {
    return ScalableSimulation([this](int wanted) { return make(wanted); }, cells);
  }
  static void goOver(ScalableSimulation& simulation, int cells) {
    simulation.setCells(cells);
    while (!simulation.update()) std::this_thread::yield();
    ASSERT_EQ(simulation.current().solver().layout().cells, cells);
  }
  static void run(FluidSimulation& simulation, int ticks) {
    for (int i = 0; i < ticks; ++i) simulation.step(kTick, {}, {});
  }

  /// Of the whole fire, in units that do not depend on the cells.
  struct Sums {
    double energy = 0.0;  ///< metres^5 a second^2
    double heat = 0.0;    ///< metres^3
    double height = 0.0;  ///< of the heat, metres
    double smoke = 0.0;   ///< mean height of the particles, metres
  };
  static Sums sumsOf(const FluidSimulation& simulation) {
    Sums sums;
    const FluidSolver& solver = simulation.solver();
    const Layout& layout = solver.layout();
    const double cell = static_cast<double>(solver.cellSize());
    const double volume = cell * cell * cell;
    sums.energy = kineticEnergy(layout, solver.velocity()) * volume;
    for (int z = 0; z < layout.cells; ++z) {
      for (int y = 0; y < layout.cells; ++y) {
        for (int x = 0; x < layout.cells; ++x) {
          const double heat = static_cast<double>(solver.temperature()[layout.index(x, y, z)]) * volume;
          sums.heat += heat;
          sums.height += heat * (y + 0.5) * cell;
        }
      }
    }
    sums.height /= sums.heat;
    for (const float y : simulation.particles().y) sums.smoke += static_cast<double>(y);
    sums.smoke /= static_cast<double>(simulation.particles().count());
    return sums;
  }

  const world::RayScene nothing_{world::Triangles{}};
};

TEST(CellsAtTest, StepsAreOneAndAHalfAndTwoTimesAsFine) {
  EXPECT_EQ(cellsAt(64, 0), 64);
  EXPECT_EQ(cellsAt(64, 1), 96);
  EXPECT_EQ(cellsAt(64, 2), 128);
  EXPECT_EQ(cellsAt(24, 1), 40) << "multiples of 8";
  EXPECT_EQ(cellsAt(128, 0), 128);
  EXPECT_EQ(cellsAt(128, 2), 128) << "the finest there is";
}

TEST_F(ScalableSimulationTest, StateIsTakenOver) {
  struct Case {
    int from;
    int to;
    double lost;  ///< of the energy, at most: the finer the grid, the smoother is what is on it
  };
  for (const auto& [from, to, lost] : {Case{32, 48, 0.12}, {64, 96, 0.04}, {96, 64, 0.03}, {64, 32, 0.05}}) {
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

TEST_F(ScalableSimulationTest, ThePlumeGoesOnRisingAsItDid) {
  for (const auto& [from, to] : {std::pair{32, 48}, {48, 32}, {32, 64}}) {
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
      ASSERT_LE(simulation.current().outcome().residual, 1.0e-4F);
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

TEST_F(ScalableSimulationTest, GustsBlowOnTheNewGrid) {
  auto calm = scalable(32);
  auto blown = scalable(32);
  for (ScalableSimulation* each : {&calm, &blown}) {
    run(each->current(), 45);
    goOver(*each, 48);
  }
  const world::Gust gust{world::Vec3(-1.5F, 0.6F, 2.0F), world::Vec3(1.0F, 0.0F, 0.0F), 6.0F, 9.0F};
  for (int i = 0; i < 10; ++i) {
    calm.current().step(kTick, {}, {});
    blown.current().step(kTick, {&gust, 1}, {});
  }
  const auto mean = [](const Particles& particles) {
    double sum = 0.0;
    for (const float x : particles.x) sum += static_cast<double>(x);
    return sum / static_cast<double>(particles.count());
  };
  const double way = mean(blown.current().particles()) - mean(calm.current().particles());
  EXPECT_GT(way, 0.15);
}

TEST_F(ScalableSimulationTest, TheNewestWishWins) {
  auto simulation = scalable(16);
  run(simulation.current(), 5);
  simulation.setCells(64);
  EXPECT_FALSE(simulation.update());
  simulation.setCells(24);
  while (!simulation.update()) run(simulation.current(), 1);
  EXPECT_EQ(simulation.current().solver().layout().cells, 24);

  // Back to where it is: nothing changes.
  simulation.setCells(64);
  EXPECT_FALSE(simulation.update());
  simulation.setCells(24);
  for (int i = 0; i < 200; ++i) {
    EXPECT_FALSE(simulation.update());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(simulation.current().solver().layout().cells, 24);
}

TEST_F(ScalableSimulationTest, WishesFromManyThreadsWhileItTicks) {
  auto simulation = scalable(16);
  std::atomic<bool> done = false;
  std::vector<std::thread> visitors;
  for (int i = 0; i < 3; ++i) {
    visitors.emplace_back([&, i] {
      for (int k = i; !done; ++k) {
        simulation.setCells(cellsAt(16, k % 3));
        std::this_thread::sleep_for(std::chrono::milliseconds(1 + i));
      }
    });
  }
  int changes = 0;
  for (int i = 0; i < 300 || changes < 5; ++i) {
    changes += simulation.update() ? 1 : 0;
    run(simulation.current(), 1);
    ASSERT_EQ(simulation.current().tick(), static_cast<std::uint64_t>(i + 1));
    ASSERT_LE(simulation.current().outcome().residual, 1.0e-4F);
  }
  done = true;
  for (std::thread& each : visitors) each.join();
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

TEST_F(ScalableSimulationTest, WhatCannotBeMadeLeavesEverythingAsItIs) {
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
