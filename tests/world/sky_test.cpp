#include "world/sky.h"

#include <gtest/gtest.h>

namespace grove::world {
namespace {

TEST(Sky, SunIsLow) {
  const Vec3 sun = Sky().sun;
  EXPECT_NEAR(glm::length(sun), 1.0F, 1e-5F);
  EXPECT_GT(sun.y, 0.05F);
  EXPECT_LT(sun.y, 0.4F);
}

/// Fails if a part of the light keeps the sun of another world.
TEST(Sky, TurnsWithTheSun) {
  const Sky evening;
  Sky opposite;
  opposite.sun *= Vec3(-1, 1, -1);
  for (const Vec3 raw : {Vec3(1, 0, 0), Vec3(-0.4F, 0.2F, -0.9F), Vec3(0.2F, 0.9F, 0.5F)}) {
    const Vec3 direction = glm::normalize(raw);
    const Vec3 turned = direction * Vec3(-1, 1, -1);
    EXPECT_NE(evening.radiance(direction), evening.radiance(turned));
    EXPECT_EQ(evening.radiance(direction), opposite.radiance(turned));
    EXPECT_EQ(evening.ambient(direction), opposite.ambient(turned));
    EXPECT_EQ(evening.hazeColour(direction), opposite.hazeColour(turned));
  }
}

TEST(Sky, MeetsTheHazeAtTheHorizon) {
  const Sky light;
  EXPECT_EQ(light.radiance({1, 0, 0}), light.hazeColour({1, 0, 0}));
  EXPECT_GT(light.hazeColour(light.sun).r, 2.0F * light.hazeColour(-light.sun).r);
}

}  // namespace
}  // namespace grove::world
