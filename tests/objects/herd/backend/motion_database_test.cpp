#include "objects/herd/backend/motion/motion_database.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "objects/herd/common/deer_skeleton.h"

namespace grove::objects::herd {
namespace {

std::vector<float> numbersOf(const MotionFrame& frame) {
  std::vector<float> numbers{frame.root.place.x, frame.root.place.y, frame.root.yaw, static_cast<float>(frame.contacts),
                             static_cast<float>(frame.activity)};
  for (const float value : std::bit_cast<std::array<float, kPostureValues>>(frame.posture)) numbers.push_back(value);
  for (const world::Vec3& foot : frame.feet) numbers.insert(numbers.end(), {foot.x, foot.y, foot.z});
  return numbers;
}

// Fault: a herd that differs from machine to machine, or from start to start.
TEST(MotionDatabase, MakesTheSameClipsAgain) {
  const MotionDatabase one(2);
  const MotionDatabase other(2);
  ASSERT_EQ(one.frames().size(), other.frames().size());
  for (MotionDatabase::Frame i = 0; i < one.frames().size(); ++i) {
    ASSERT_EQ(numbersOf(one[i]), numbersOf(other[i])) << "frame " << i;
  }
}

// Fault: variants that repeat the same motion.
TEST(MotionDatabase, GrowsByVariants) {
  const MotionDatabase one(1);
  const MotionDatabase two(2);
  EXPECT_EQ(two.clips(), 2 * one.clips());
  EXPECT_EQ(two.frames().size(), 2 * one.frames().size());
  std::size_t same = 0;
  for (MotionDatabase::Frame i = 0; i < one.frames().size(); ++i) {
    if (numbersOf(two[i]) == numbersOf(two[static_cast<MotionDatabase::Frame>(one.frames().size()) + i])) ++same;
  }
  EXPECT_LT(same, one.frames().size() / 20);
}

// Faults: feet that slide; legs too short for their feet; frames that jump.
TEST(MotionDatabase, HasFeetThatStand) {
  const MotionDatabase database(1);
  for (MotionDatabase::Frame i = 0; i + 1 < database.frames().size(); ++i) {
    if (database.endOf(i) == i + 1) continue;
    const MotionFrame& now = database[i];
    const MotionFrame& next = database[i + 1];
    AnimalPose pose;
    pose.posture = now.posture;
    pose.feet = now.feet;
    const std::array<LegChain, kLegs> legs = legsOf(pose, 1.0F);
    for (std::size_t leg = 0; leg < kLegs; ++leg) {
      const auto placeOf = [leg](const MotionFrame& frame) {
        return frame.root.place + frame.root.turned({frame.feet[leg].x, frame.feet[leg].z});
      };
      const float moved = glm::distance(placeOf(now), placeOf(next));
      const bool stands = now.isOnGround(leg) && next.isOnGround(leg);
      ASSERT_LT(moved, stands ? 0.001F : 0.8F) << "frame " << i << ", leg " << leg;
      ASSERT_LT(glm::distance(legs[leg].back(), now.feet[leg]), now.isOnGround(leg) ? 0.03F : 0.05F)
          << "frame " << i << ", leg " << leg;
    }
  }
}

// Fault: an activity that the generator forgets.
TEST(MotionDatabase, HasAllActivities) {
  const MotionDatabase database(1);
  std::array<std::size_t, kActivities> frames{};
  for (const MotionFrame& frame : database.frames()) ++frames[static_cast<std::size_t>(frame.activity)];
  for (const std::size_t count : frames) EXPECT_GT(count, 200U);
}

}  // namespace
}  // namespace grove::objects::herd
