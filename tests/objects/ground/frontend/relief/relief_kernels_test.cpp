#include "objects/ground/frontend/relief/relief_kernels.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "each_target.h"

namespace grove::objects::ground {
namespace {

const std::vector<world::Hill> kHills{
    {{-6.0F, -14.0F}, 9.0F, 1.1F}, {{4.0F, -30.0F}, 14.0F, 1.5F}, {{40.0F, 40.0F}, 10.0F, 1.0F}};

world::Camera cameraAt(float yaw, float pitch) {
  return {.pose = {.position = {-3.0F, 1.75F, 2.0F}, .yaw = yaw, .pitch = pitch}, .width = 1280, .height = 720};
}

/// Depth where a ray first meets the ground, by small steps.
float depthOf(const Frame& frame, const GroundRow& ground, float side, float most) {
  const float dx = ground.ahead * frame.forwardX + side * frame.sideX;
  const float dz = ground.ahead * frame.forwardZ + side * frame.sideZ;
  constexpr float kStep = 2e-3F;
  float depth = 0.05F;
  while (depth < most) {
    const world::Vec2 place(frame.eyeX + depth * dx, frame.eyeZ + depth * dz);
    const float above = frame.eyeY + depth * ground.rise - world::groundHeight(kHills, place);
    if (above <= 0.0F) break;
    depth += std::max(kStep, 0.2F * above);
  }
  return depth;
}

/// Fails if a ray passes through a hill, or ends before it. Near the crest of a hill a ray may miss it by 2 cm.
TEST(ReliefKernels, FindWhereRaysMeetHills) {
  const world::Camera camera = cameraAt(0.1F, -0.08F);
  const Frame frame = frameOf(camera);
  tests::onEachTarget([&] {
    int onHills = 0;
    int strayed = 0;
    for (const int firstColumn : {0, 480, 960}) {
      GroundRow ground;
      const GroundRow* nearer = nullptr;
      for (int row = 740; row > 330; --row) {
        findGround(frame, kHills, row, firstColumn, nearer, ground);
        nearer = &ground;
        ASSERT_EQ(ground.row, row);
        for (int i = 0; i < kCoarseSamples; ++i) {
          const auto at = static_cast<std::size_t>(i);
          const float side = frame.firstSide + static_cast<float>(firstColumn + i * kCoarse) * frame.sideStep;
          const float exact = depthOf(frame, ground, side, kFarthest);
          if (std::abs(ground.depth[at] - exact) > 0.01F * exact + 0.02F) ++strayed;
          const float height = world::groundHeight(kHills, {ground.x[at], ground.z[at]});
          const float y = frame.eyeY + ground.depth[at] * ground.rise;
          const bool isFar = exact > 100.0F;
          ASSERT_TRUE(isFar || std::abs(y - height) < 0.02F) << row << " " << i;
          if (height > 0.1F) ++onHills;
        }
      }
    }
    EXPECT_LE(strayed, 100) << "of " << 3 * 410 * kCoarseSamples;
    EXPECT_GT(onHills, 2000);
  });
}

/// Fails if a crest hides nothing.
TEST(ReliefKernels, DepthGrowsFromRowToRow) {
  const Frame frame = frameOf(cameraAt(0.0F, -0.05F));
  GroundRow nearer;
  findGround(frame, kHills, 719, 480, nullptr, nearer);
  for (int row = 718; row > 340; --row) {
    GroundRow ground;
    findGround(frame, kHills, row, 480, &nearer, ground);
    for (std::size_t i = 0; i < kCoarseSamples; ++i) {
      ASSERT_GE(ground.depth[i], nearer.depth[i] * 0.998F);
      ASSERT_GE(ground.step[i], 0.0F);
    }
    nearer = ground;
  }
}

/// Fails if blades on a crest have the light of the meadow far behind them.
TEST(ReliefKernels, RowsAboveACrestShowItsLight) {
  const world::Camera camera = cameraAt(0.45F, -0.03F);
  const Frame frame = frameOf(camera);
  const std::vector<world::Hill> hill{{{-9.5F, -12.0F}, 7.0F, 1.3F}};
  GroundRow nearer;
  findGround(frame, hill, 719, 560, nullptr, nearer);
  int jumps = 0;
  int lit = 0;
  for (int row = 718; row > 345; --row) {
    GroundRow ground;
    findGround(frame, hill, row, 560, &nearer, ground);
    for (std::size_t i = 0; i < kCoarseSamples; ++i) {
      if (ground.depth[i] > 1.5F * nearer.depth[i]) {
        ++jumps;
        ASSERT_EQ(ground.litX[i], nearer.x[i]);
        ASSERT_EQ(ground.litDepth[i], nearer.depth[i]);
      }
      if (ground.litDepth[i] < 0.99F * ground.depth[i]) ++lit;
    }
    nearer = ground;
  }
  EXPECT_GT(jumps, 5);
  EXPECT_GT(lit, 2 * jumps) << "blades on a crest reach several rows";
  EXPECT_LT(lit, 15 * jumps);
}

/// Fails if a strip lacks a hill that its rays meet.
TEST(ReliefKernels, HillsBeforeAStripAreAllThatCount) {
  for (const float pitch : {-0.7F, -0.2F, 0.1F}) {
    const Frame frame = frameOf(cameraAt(0.3F, pitch));
    for (const int firstColumn : {-160, 0, 640, 1120}) {
      const auto before = hillsBefore(frame, firstColumn, 340, 760, kHills);
      EXPECT_LT(before.size(), kHills.size()) << "one is behind";
      GroundRow all;
      GroundRow some;
      const GroundRow* nearerOfAll = nullptr;
      const GroundRow* nearerOfSome = nullptr;
      for (int row = 760; row >= 340; row -= 3) {
        findGround(frame, kHills, row, firstColumn, nearerOfAll, all);
        findGround(frame, before, row, firstColumn, nearerOfSome, some);
        nearerOfAll = &all;
        nearerOfSome = &some;
        for (std::size_t i = 0; i < kCoarseSamples; ++i) ASSERT_NEAR(some.x[i], all.x[i], 0.05F) << row;
      }
    }
  }
}

}  // namespace
}  // namespace grove::objects::ground
