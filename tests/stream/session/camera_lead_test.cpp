#include "stream/session/camera_lead.h"

#include <gtest/gtest.h>

#include <vector>

namespace grove::stream {
namespace {

constexpr double kFrameSeconds = 1.0 / 30.0;
constexpr double kLead = 0.17;

// Faults: a picture from where the visitor was; a lead through a stone.
TEST(CameraLead, IsWhereTheKeysLead) {
  world::Players players({0, 0, 0}, 0.0F, 40.0F, {{{0.0F, -5.0F}, 1.0F}});
  const world::PlayerId id = players.join("Ada", 0.0);
  ASSERT_TRUE(players.apply(id, {1, world::kForward, 0.0F, 0.0F}, 0.0));
  CameraLead lead;
  std::vector<world::Vec3> ahead;
  constexpr int kFramesAhead = 5;
  for (int frame = 1; frame < 90; ++frame) {
    const double now = frame * kFrameSeconds;
    const world::Player player = *players.find(id, now);
    if (frame > kFramesAhead) {
      EXPECT_LT(glm::distance(player.pose.position, ahead[static_cast<std::size_t>(frame - kFramesAhead - 1)]), 0.03F);
    }
    ahead.push_back(lead.poseAhead(players, player, kFramesAhead * kFrameSeconds, now).position);
  }
}

TEST(CameraLead, IsNothingForOtherPages) {
  world::Players players({0, 0, 0}, 0.0F, 40.0F, {});
  const world::PlayerId id = players.join("Ada", 0.0);
  ASSERT_TRUE(players.apply(id, {1, world::kForward, 0.5F, 0.0F}, 0.0));
  CameraLead lead;
  for (const double now : {0.1, 0.2, 0.3}) {
    EXPECT_EQ(lead.poseAhead(players, *players.find(id, now), 0.0, now), players.find(id, now)->pose);
  }
}

// Faults: a turn that is not led; one jerk of the mouse that throws the picture aside; a turn the long way round; one
// that goes on although it has ended.
TEST(TurnLead, FollowsTurnsThatGoOn) {
  TurnLead turn;
  EXPECT_EQ(turn.turnAhead(3.1F, kFrameSeconds, kLead), 0.0F);
  EXPECT_EQ(turn.turnAhead(3.1F, kFrameSeconds, kLead), 0.0F);
  EXPECT_EQ(turn.turnAhead(-3.1F, kFrameSeconds, kLead), 0.0F) << "it may be a jerk";
  EXPECT_NEAR(turn.turnAhead(-3.05F, kFrameSeconds, kLead), 0.05 / kFrameSeconds * kLead, 1e-3)
      << "the slower of two rates";
  EXPECT_EQ(turn.turnAhead(-3.05F, kFrameSeconds, kLead), 0.0F);
  EXPECT_EQ(turn.turnAhead(-3.1F, kFrameSeconds, kLead), 0.0F);
  EXPECT_EQ(turn.turnAhead(-3.0F, kFrameSeconds, kLead), 0.0F) << "it has turned round";
}

TEST(TurnLead, IsLimited) {
  TurnLead turn;
  static_cast<void>(turn.turnAhead(0.0F, kFrameSeconds, kLead));
  static_cast<void>(turn.turnAhead(0.5F, kFrameSeconds, kLead));
  EXPECT_FLOAT_EQ(turn.turnAhead(1.0F, kFrameSeconds, kLead), 0.3F);
  EXPECT_EQ(turn.turnAhead(1.5F, 5.0, kLead), 0.0F) << "five seconds ago";
}

}  // namespace
}  // namespace grove::stream
