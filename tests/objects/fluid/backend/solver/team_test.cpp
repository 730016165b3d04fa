#include "objects/fluid/backend/solver/team.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "objects/fluid/backend/simulation/fluid_simulation.h"
#include "objects/fluid/backend/solver/diagnostics.h"
#include "sanitized.h"
#include "world/rays/ray_obstacles.h"
#include "world/sky.h"

namespace grove::objects::fluid {
namespace {

TEST(TeamTest, EveryPartIsDoneOnceEachTime) {
  for (const int width : {1, 2, 5}) {
    Team team(width);
    std::vector<int> done(static_cast<std::size_t>(width));
    for (int round = 1; round <= 50; ++round) {
      team.run([&](int part) { ++done[static_cast<std::size_t>(part)]; });
      for (const int times : done) ASSERT_EQ(times, round);
    }
  }
}

TEST(TeamTest, SlabsCoverAllPlanesAndAreEven) {
  for (const int cells : {16, 24, 64, 96, 128}) {
    for (int parts = 1; parts <= 16; ++parts) {
      int next = 0;
      for (int part = 0; part < parts; ++part) {
        const Slab slab = Slab::of(part, parts, cells);
        EXPECT_EQ(slab.first, next);
        EXPECT_EQ(slab.end % 2, 0);
        EXPECT_LE(slab.end - slab.first, (cells + parts - 1) / parts + 2);
        next = slab.end;
      }
      EXPECT_EQ(next, cells);
    }
  }
}

/// Fires amid a wall, a gust and a visitor, by so many threads.
class TeamOnAFire : public testing::TestWithParam<int> {};

TEST_P(TeamOnAFire, MatchesOneThread) {
  world::Triangles wall;
  wall.positions = {{-2.0F, 0.0F, 0.6F}, {2.0F, 0.0F, 0.6F}, {2.0F, 2.0F, 0.6F}, {-2.0F, 2.0F, 0.6F}};
  wall.indices = {{0, 1, 2}, {0, 2, 3}};
  const world::RayScene surfaces(wall);
  const world::RayObstacles solids(surfaces, surfaces);
  FluidSettings settings;
  settings.grid = kSanitized ? 32 : 48;
  settings.size = 6.0F;
  FluidSimulation alone(settings, {}, solids, world::Sky());
  settings.threads = GetParam();
  FluidSimulation together(settings, {}, solids, world::Sky());
  world::Player player;
  player.velocity = {0.0F, 0.0F, 1.5F};
  for (int i = 0; i < (kSanitized ? 15 : 40); ++i) {
    player.pose.position = {0.7F, world::kEyeHeight, -1.5F + 0.05F * static_cast<float>(i)};
    const world::Gust gust{world::Vec3(-2.0F, 0.6F, 0.0F), world::Vec3(1.0F, 0.0F, 0.2F), i % 20 < 3 ? 12.0F : 0.0F,
                           9.0F};
    for (FluidSimulation* each : {&alone, &together}) each->step(FluidSimulation::kTick, {&gust, 1}, {&player, 1});
  }
  ASSERT_GT(alone.particles().count(), 300U);
  EXPECT_EQ(alone.particles().x, together.particles().x);
  EXPECT_EQ(alone.particles().y, together.particles().y);
  EXPECT_EQ(alone.result().iterations, together.result().iterations);
  const Layout& layout = alone.solver().layout();
  for (int a = 0; a < 3; ++a) {
    const Field& one = alone.solver().velocity().axis(a);
    const Field& other = together.solver().velocity().axis(a);
    int differ = 0;
    for (int z = 0; z < layout.cells; ++z) {
      for (int y = 0; y < layout.cells; ++y) {
        for (int x = 0; x < layout.cells; ++x) {
          const std::ptrdiff_t i = layout.index(x, y, z);
          differ += one[i] == other[i] ? 0 : 1;
        }
      }
    }
    EXPECT_EQ(differ, 0) << "faces across axis " << a;
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, TeamOnAFire, testing::Values(2, 3, 6));

}  // namespace
}  // namespace grove::objects::fluid
