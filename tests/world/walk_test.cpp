#include "world/walk.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <vector>

#include "pipeline/embedded.h"
#include "world/players.h"
#include "world/scenes/scene_file.h"

namespace grove::world {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(Walk, ParsesLines) {
  const Walk walk = parseWalk(
      "# a walk\n"
      "0 1 2 0.5 -0.25   # begins here\r\n"
      "\n"
      "\t2.5  1  1.2  4  0.5  1.5",
      "a.walk");
  EXPECT_EQ(walk.seconds(), 2.5);
  const Pose first = walk.at(0.0);
  EXPECT_EQ(first.position, Vec3(1, kEyeHeight, 2));
  EXPECT_EQ(first.yaw, 0.5F);
  EXPECT_EQ(first.pitch, -0.25F);
  EXPECT_EQ(walk.at(2.5).position, Vec3(1, 1.2F, 4)) << "six numbers: with the height";
}

TEST(Walk, InterpolatesLinearly) {
  const Walk walk = parseWalk("1 0 0 0 0\n3 4 -2 1 0.5\n4 4 -2 1 0.5\n", "a.walk");
  EXPECT_EQ(walk.at(0.0).position, Vec3(0, kEyeHeight, 0)) << "before it begins, it waits";
  const Pose middle = walk.at(1.5);
  EXPECT_NEAR(middle.position.x, 1.0F, 1e-6F);
  EXPECT_NEAR(middle.position.z, -0.5F, 1e-6F);
  EXPECT_NEAR(middle.yaw, 0.25F, 1e-6F);
  EXPECT_NEAR(middle.pitch, 0.125F, 1e-6F);
  EXPECT_EQ(walk.at(99.0).position, Vec3(4, kEyeHeight, -2));
}

// Fault: cameras of benches pass through hills, or those with a height of their own stay level.
TEST(Walk, HeightsCountFromTheGround) {
  const std::vector<Hill> hills{{{5.0F, 0.0F}, 4.0F, 1.2F}};
  const Walk walk = parseWalk("0 0 0 0 0\n10 10 0 0 0\n20 5 0.4 0 0 0\n", "a.walk");
  for (const double seconds : {0.0, 2.0, 4.0, 5.0, 6.5, 10.0}) {
    const Vec3 eye = onGround(walk.at(seconds), hills).position;
    EXPECT_NEAR(eye.y, kEyeHeight + groundHeight(hills, {eye.x, eye.z}), 1e-5F) << seconds;
  }
  EXPECT_NEAR(onGround(walk.at(5.0), hills).position.y, kEyeHeight + 1.2F, 1e-5F);
  EXPECT_NEAR(onGround(walk.at(20.0), hills).position.y, 0.4F + 1.2F, 1e-5F);
}

/// Or somebody who looks past the south would whirl around.
TEST(Walk, TurnsTheShortWay) {
  const Walk walk = parseWalk("0 0 0 3.0 0\n1 0 0 -3.0 0\n2 0 0 9.0 0\n", "a.walk");
  EXPECT_NEAR(std::remainder(walk.at(0.5).yaw - 3.14159F, 6.2831853F), 0.0F, 1e-4F);
  EXPECT_NEAR(walk.at(0.25).yaw, 3.0F + 0.25F * 0.28319F, 1e-4F);
  EXPECT_NEAR(std::remainder(walk.at(1.5).yaw + 3.14159F, 6.2831853F), 0.0F, 0.2F);
}

TEST(Walk, ReversesAtItsEnd) {
  const Walk walk = parseWalk("0 0 0 0 0\n10 10 0 0 0\n", "a.walk");
  for (const auto& [seconds, x] :
       {std::pair(0.0, 0.0F), {4.0, 4.0F}, {10.0, 10.0F}, {13.0, 7.0F}, {20.0, 0.0F}, {21.0, 1.0F}}) {
    EXPECT_NEAR(walk.thereAndBack(seconds).position.x, x, 1e-5F) << seconds;
  }
  EXPECT_EQ(parseWalk("0 3 0 0 0", "a.walk").thereAndBack(7.0).position.x, 3.0F);
}

TEST(Walk, RefusesMalformedFiles) {
  const auto reason = [](const std::string& text) -> std::string {
    try {
      (void)parseWalk(text, "b.walk");
      return "";
    } catch (const WalkError& e) {
      return e.what();
    }
  };
  EXPECT_THAT(reason(""), StartsWith("b.walk:1: "));
  EXPECT_THAT(reason("# nothing\n\n"), StartsWith("b.walk:2: "));
  EXPECT_THAT(reason("0 0 0 0 0\n1 0 0 0\n"), StartsWith("b.walk:2: 4 numbers"));
  EXPECT_THAT(reason("0 0 0 0 0 0 0\n"), StartsWith("b.walk:1: 7 numbers"));
  EXPECT_THAT(reason("0 0 x 0 0\n"), StartsWith("b.walk:1: not a number"));
  EXPECT_THAT(reason("0 0 1e 0 0\n"), HasSubstr("not a number"));
  EXPECT_THAT(reason("0 0 nan 0 0\n"), HasSubstr("not a number"));
  EXPECT_THAT(reason("0 0 inf 0 0\n"), HasSubstr("not a number"));
  EXPECT_THAT(reason("0,0,0,0,0\n"), HasSubstr("not a number"));
  EXPECT_THAT(reason("-1 0 0 0 0\n"), HasSubstr("seconds out of range"));
  EXPECT_THAT(reason("0 1e9 0 0 0\n"), HasSubstr("x out of range"));
  EXPECT_THAT(reason("0 0 0 1e9 0\n"), HasSubstr("yaw out of range"));
  EXPECT_THAT(reason("0 0 0 0 1.6\n"), HasSubstr("pitch out of range"));
  EXPECT_THAT(reason("0 0 0 0 0\n1 0 0 0 0\n1 0 0 0 0\n"), StartsWith("b.walk:3: a time"));
  EXPECT_THROW((void)loadWalk("/no/such.walk"), std::exception);
}

/// The walks that are measured on must be such as a visitor could make: within the built-in world, and through nothing.
TEST(Walk, TestWalksAreWalkable) {
  const Scene scene = parseScene(embedded::scenes().front().text(), "grove.toml");
  for (const char* name : {"clearing", "under_trees", "edge", "crowd"}) {
    const Walk walk = loadWalk(std::filesystem::path(GROVE_WALKS) / (std::string(name) + ".walk"));
    EXPECT_EQ(walk.seconds(), 20.0) << name;
    float way = 0.0F;
    float turned = 0.0F;
    Pose before = walk.at(0.0);
    for (int i = 1; i <= 1000; ++i) {
      const double t = 0.02 * i;
      const Pose pose = walk.at(t);
      const float step = glm::length(pose.position - before.position);
      way += step;
      turned += std::abs(pose.yaw - before.yaw);
      ASSERT_LT(step / 0.02F, kRunSpeed) << name << " at " << t;
      ASSERT_LT(std::abs(std::remainder(pose.yaw - before.yaw, 6.2831853F)) / 0.02F, 5.0F) << name << " at " << t;
      ASSERT_LT(std::hypot(pose.position.x, pose.position.z), scene.radius) << name << " at " << t;
      for (const ObjectDescription& object : scene.objects) {
        const std::string plant = object.type == "lightfield" ? object.parameters.text("plant", "") : "";
        const bool isTree = plant == "oak" || plant == "birch" || plant == "spruce";
        const bool isSolid = object.type == "mesh" && object.name != "the lintel";
        if (!isTree && !isSolid) continue;
        const Vec3 away = object.transform.position - pose.position;
        ASSERT_GT(std::hypot(away.x, away.z), isTree ? 1.0F : 0.85F) << name << " at " << t << ": " << object.name;
      }
      before = pose;
    }
    EXPECT_GT(way, 15.0F) << name;
    EXPECT_GT(turned, 2.0F) << name;
  }
}

}  // namespace
}  // namespace grove::world
