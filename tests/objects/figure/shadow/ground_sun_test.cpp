#include "objects/figure/backend/shadow/ground_sun.h"

#include <gtest/gtest.h>

#include "objects/figure/shadow/sun_wall.h"

namespace grove::objects::figure {
namespace {

/// Would catch shadows that show where trees already shade the ground, and none where the sun shines.
TEST(GroundSun, EndsBehindWhatStandsBeforeTheSun) {
  pipeline::MemoryLedger memory;
  const world::RayScene rays(sunWall(0.0F));
  const GroundSun ground(10.0F, kSunOfWall, {}, rays, memory);
  EXPECT_FLOAT_EQ(ground.at(3.0F, 2.0F), 1.0F) << "beside the wall";
  EXPECT_FLOAT_EQ(ground.at(-3.0F, 2.0F), 0.0F) << "behind it";
  EXPECT_FLOAT_EQ(ground.at(-3.0F, -2.0F), 1.0F) << "before it";
  EXPECT_FLOAT_EQ(ground.at(-3.0F, 2.0F), 0.0F) << "as before";
  EXPECT_FLOAT_EQ(ground.at(30.0F, 2.0F), ground.at(10.0F, 2.0F)) << "beyond its end";
}

/// Would catch a shadow that begins and ends in steps.
TEST(GroundSun, ChangesGradually) {
  pipeline::MemoryLedger memory;
  const world::RayScene rays(sunWall(0.0F));
  const GroundSun ground(10.0F, kSunOfWall, {}, rays, memory);
  float before = ground.at(-1.0F, 2.0F);
  for (int centimetre = -99; centimetre <= 100; ++centimetre) {
    const float share = ground.at(0.01F * static_cast<float>(centimetre), 2.0F);
    ASSERT_LT(std::abs(share - before), 0.06F) << centimetre;
    before = share;
  }
}

/// Would catch blades and flowers that take the shadow away, through which the sun reaches the ground.
TEST(GroundSun, LowThingsLetTheSunPass) {
  pipeline::MemoryLedger memory;
  const world::RayScene rays(sunWall(0.0F, 0.5F));
  EXPECT_FLOAT_EQ(GroundSun(10.0F, kSunOfWall, {}, rays, memory).at(-3.0F, 0.3F), 1.0F);
}

// Fault: visitors on a hill cast no shadow, because at the hill's foot it is shady.
TEST(GroundSun, HillsRiseAboveShadows) {
  pipeline::MemoryLedger memory;
  const world::RayScene rays(sunWall(0.0F, 1.5F));
  const std::vector<world::Hill> hills{{{-3.0F, 2.0F}, 5.0F, 1.5F}};
  EXPECT_FLOAT_EQ(GroundSun(10.0F, kSunOfWall, {}, rays, memory).at(-3.0F, 2.0F), 0.0F);
  EXPECT_FLOAT_EQ(GroundSun(10.0F, kSunOfWall, hills, rays, memory).at(-3.0F, 2.0F), 1.0F);
}

}  // namespace
}  // namespace grove::objects::figure
