#include "node/frontend/backdrops/eye_motion.h"

#include <gtest/gtest.h>

#include <numbers>

namespace grove::node {
namespace {

constexpr double kFrameSeconds = 1.0 / 30.0;

world::Camera at(float x, float yaw) { return {.pose = {.position = {x, 1.7F, 0.0F}, .yaw = yaw}}; }

TEST(EyeMotion, Extrapolates) {
  EyeMotion motion;
  for (int i = 0; i < 20; ++i) {
    motion.see(at(0.05F * static_cast<float>(i), 0.02F * static_cast<float>(i)), i * kFrameSeconds);
  }
  EXPECT_NEAR(motion.secondsPerFrame(), 1.0F / 30.0F, 1e-4F);
  const world::Camera next = motion.ahead(at(1.0F, 0.4F), motion.secondsPerFrame());
  EXPECT_NEAR(next.pose.position.x, 1.05F, 1e-3F);
  EXPECT_NEAR(next.pose.yaw, 0.42F, 1e-3F);
}

TEST(EyeMotion, TurnsTheShortWay) {
  EyeMotion motion;
  motion.see(at(0.0F, 3.1F), 0.0);
  motion.see(at(0.0F, -3.1F), kFrameSeconds);
  const float turned = 2.0F * std::numbers::pi_v<float> - 6.2F;
  EXPECT_NEAR(motion.ahead(at(0.0F, 0.0F), 1.0F / 30.0F).pose.yaw, turned, 1e-3F);
}

TEST(EyeMotion, IgnoresTeleportsAndPauses) {
  EyeMotion motion;
  motion.see(at(0.0F, 0.0F), 0.0);
  motion.see(at(20.0F, 0.0F), kFrameSeconds);
  EXPECT_EQ(motion.ahead(at(20.0F, 0.0F), 1.0F).pose.position.x, 20.0F);
  motion.see(at(20.1F, 0.1F), 2.0 * kFrameSeconds);
  motion.see(at(20.5F, 0.9F), 3.0);
  EXPECT_EQ(motion.ahead(at(20.5F, 0.9F), 1.0F).pose.position.x, 20.5F);
  EXPECT_EQ(motion.ahead(at(20.5F, 0.9F), 1.0F).pose.yaw, 0.9F);
}

TEST(EyeMotion, StopsAtTheZenith) {
  EyeMotion motion;
  world::Camera camera;
  for (int i = 0; i < 3; ++i) {
    camera.pose.pitch = 0.4F * static_cast<float>(i);
    motion.see(camera, i * kFrameSeconds);
  }
  EXPECT_EQ(motion.ahead(camera, 1.0F).pose.pitch, world::kMaxPitch);
}

}  // namespace
}  // namespace grove::node
