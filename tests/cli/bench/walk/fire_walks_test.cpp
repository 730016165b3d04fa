#include "cli/bench/walk/fire_walks.h"

#include <gtest/gtest.h>

#include <cmath>

namespace grove::cli {
namespace {

/// Fails if benches on a hill look over the fire or into the ground.
TEST(FireWalks, LookAtTheFireFromTheGround) {
  world::Layout layout;
  layout.spawn = {0.0F, 0.0F, 9.0F};
  layout.hills = {{{0.0F, 7.0F}, 6.0F, 1.4F}};
  layout.lights.resize(1);
  const world::Vec3 fire(0.0F, 0.8F, 0.0F);
  layout.lights.front().light.position = fire;
  for (const world::Walk& walk : {roundWalk(layout), standingWalk(layout)}) {
    const world::Pose pose = onGround(walk.at(0.0), layout.hills);
    const world::Vec3 way = fire - pose.position;
    EXPECT_GT(pose.position.y, 2.0F);
    EXPECT_NEAR(std::tan(pose.pitch), way.y / std::hypot(way.x, way.z), 1e-4F);
    EXPECT_NEAR(pose.yaw, std::atan2(-way.x, -way.z), 1e-4F);
  }
}

}  // namespace
}  // namespace grove::cli
