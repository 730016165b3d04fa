#include "world/layout.h"

#include <gtest/gtest.h>

#include <vector>

#include "world/ground/ground_shadow.h"

namespace grove::world {
namespace {

TEST(Layout, PlacesVisitorsByTheTemplate) {
  Layout layout;
  Player player;
  player.id = 7;
  player.name = "Ada";
  player.pose.position = {3.0F, kEyeHeight, -2.0F};
  player.pose.yaw = 0.5F;
  EXPECT_FALSE(layout.objectOf(player)) << "visitors are invisible";
  layout.visitor.emplace();
  layout.visitor->object.type = 4;
  layout.visitor->bounds = {Vec3(-1.0F, 0.0F, -1.0F), Vec3(1.0F, 2.0F, 1.0F)};
  const auto object = layout.objectOf(player);
  ASSERT_TRUE(object);
  EXPECT_EQ(object->id, kFirstPlayerObject + 7);
  EXPECT_EQ(object->type, 4U);
  EXPECT_EQ(object->name, "Ada");
  EXPECT_FLOAT_EQ(object->transform.yaw, 0.5F);
  EXPECT_FLOAT_EQ(object->bounds.low.y, 0.0F) << "on the ground";
  EXPECT_FLOAT_EQ(object->bounds.centre().x, 3.0F);
}

/// Would catch shadows that are cut off where their object's bounds end.
TEST(Layout, BoundsOfVisitorsIncludeTheirShadows) {
  Layout layout;
  layout.sky.sun = glm::normalize(Vec3(0.0F, 0.5F, -1.0F));
  layout.visitor.emplace();
  layout.visitor->bounds = {Vec3(-0.5F, 0.0F, -0.5F), Vec3(0.5F, 2.0F, 0.5F)};
  Player player;
  player.pose.position = {3.0F, kEyeHeight, -2.0F};
  EXPECT_FALSE(layout.shadowOf(player));
  EXPECT_FLOAT_EQ(layout.objectOf(player)->bounds.high.z, -1.5F);
  layout.visitor->castsShadow = true;
  const Bounds whole = layout.objectOf(player)->bounds;
  EXPECT_FLOAT_EQ(whole.low.z, -2.5F);
  EXPECT_FLOAT_EQ(whole.high.z, -1.5F + 2.0F / 0.5F) << "away from the sun by height / tan(elevation)";
  EXPECT_FLOAT_EQ(whole.high.y, 2.0F);
  const Bounds shadow = layout.shadowOf(player)->bounds;
  EXPECT_FLOAT_EQ(shadow.high.z, whole.high.z);
  EXPECT_LT(shadow.high.y, 0.2F) << "it lies on the ground";
  layout.sky.sun = glm::normalize(Vec3(0.0F, -0.1F, -1.0F));
  EXPECT_LE(layout.objectOf(player)->bounds.high.z, -1.499F + kLongestShadow) << "the sun has set";
}

TEST(Layout, LightsAreSceneLightsAndLanterns) {
  Layout layout;
  layout.lights = {{{{0.0F, 1.0F, 0.0F}, {2.0F, 1.0F, 0.5F}}, 0.0F}, {{{5.0F, 1.0F, 0.0F}, Vec3(1.0F)}, 1.0F}};
  std::vector<Player> players(1);
  players[0].colour = 0x0000FFU;
  players[0].pose.position = {0.0F, kEyeHeight, 4.0F};
  const auto lights = layout.lightsAt(1.0, players);
  ASSERT_EQ(lights.size(), 3U);
  EXPECT_EQ(lights[0].colour, Vec3(2.0F, 1.0F, 0.5F)) << "it is steady";
  EXPECT_NE(lights[1].colour, Vec3(1.0F)) << "it flickers";
  EXPECT_EQ(lights[1].colour, layout.lightsAt(1.0, {}).at(1).colour) << "the same for everybody";
  EXPECT_GT(lights[2].colour.x, 0.0F);
  EXPECT_EQ(lights[2].colour.z, 0.0F);
  EXPECT_LT(glm::distance(lights[2].position, players[0].pose.position), 1.0F);
}

}  // namespace
}  // namespace grove::world
