#include "world/scenes/scene_hills.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace grove::world {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// The message of the SceneError that parsing throws.
std::string refusalOf(const std::string& text) {
  try {
    (void)parseScene(text, "test.toml");
  } catch (const SceneError& e) {
    return e.what();
  }
  return "";
}

/// Fails if trees, fires or visitors stand in a hill or float above the ground.
TEST(SceneHills, CarryEverything) {
  const Scene scene = parseScene(R"(
spawn = [10, 0, 0]
[[hill]]
position = [8, 0, 0]
radius = 10
height = 1.2
[[hill]]
position = [-30, 0, 0]
radius = 5
height = 0.3
[[object]]
type = "mesh"
position = [12, 0.5, 3]
[[object]]
type = "mesh"
position = [40, 0.5, 3]
[[light]]
position = [8, 2, 0]
)",
                                 "test.toml");
  ASSERT_EQ(scene.hills.size(), 2U);
  EXPECT_EQ(scene.hills[1].centre, Vec2(-30.0F, 0.0F));
  const Transform& raised = scene.objects.at(0).transform;
  EXPECT_FLOAT_EQ(raised.position.y, 0.5F + groundHeight(scene.hills, {12.0F, 3.0F}));
  EXPECT_EQ(raised.slope, groundSlope(scene.hills, {12.0F, 3.0F}));
  EXPECT_LT(raised.slope.x, 0.0F);
  EXPECT_FLOAT_EQ(scene.objects.at(1).transform.position.y, 0.5F);
  EXPECT_EQ(scene.objects.at(1).transform.slope, Vec2(0.0F));
  EXPECT_FLOAT_EQ(scene.lights.at(0).position.y, 3.2F);
  EXPECT_FLOAT_EQ(scene.spawn.y, groundHeight(scene.hills, {10.0F, 0.0F}));
}

/// Fails if the horizon or the ground itself rises with a hill, or if a fire's cube leans.
TEST(SceneHills, LeaveSkyAndGroundAndLeanNoFluids) {
  const Scene scene = parseScene(R"(
[[hill]]
position = [4, 0, 0]
radius = 8
height = 1.2
[[object]]
type = "fluid"
position = [2, 0, 0]
[[object]]
type = "sky"
position = [2, 0, 0]
[[object]]
type = "ground"
position = [2, 0, 0]
)",
                                 "test.toml");
  ASSERT_GT(groundHeight(scene.hills, {2.0F, 0.0F}), 1.0F);
  EXPECT_FLOAT_EQ(scene.objects.at(0).transform.position.y, groundHeight(scene.hills, {2.0F, 0.0F}));
  for (const ObjectDescription& object : scene.objects) EXPECT_EQ(object.transform.slope, Vec2(0.0F)) << object.type;
  EXPECT_EQ(scene.objects.at(1).transform.position, Vec3(2.0F, 0.0F, 0.0F));
  EXPECT_EQ(scene.objects.at(2).transform.position, Vec3(2.0F, 0.0F, 0.0F));
}

/// Fails if a scene makes ground that rises above the horizon or is infinite, or if a refusal does not say how to mend
/// it.
TEST(SceneHills, AreRefusedIfBad) {
  const auto complaint = [](const std::string& keys) { return refusalOf("[[hill]]\n" + keys + "\n"); };
  EXPECT_EQ(complaint("radius = 200\nheight = 1.6"), "");
  EXPECT_EQ(complaint("radius = 0.5\nheight = 0"), "");
  EXPECT_EQ(complaint("height = 1"), "test.toml:1: hill: 'radius' is missing; it must lie between 0.5 and 200");
  EXPECT_EQ(complaint("radius = 9"), "test.toml:1: hill: 'height' is missing; it must lie between 0 and 1.6");
  for (const char* const radius : {"0", "0.4", "201", "-5", "nan", "inf"}) {
    EXPECT_EQ(complaint("height = 1\nradius = " + std::string(radius)),
              "test.toml:3: hill: 'radius' must lie between 0.5 and 200");
  }
  for (const char* const height : {"-0.1", "1.7", "nan", "-inf"}) {
    EXPECT_EQ(complaint("radius = 5\nheight = " + std::string(height)),
              "test.toml:3: hill: 'height' must lie between 0 and 1.6");
  }
  const std::string shape = "\nradius = 5\nheight = 1";
  EXPECT_EQ(complaint("position = [1, 0.1, 2]" + shape),
            "test.toml:2: hill: 'position' must have y = 0: hills rise from there by their height");
  EXPECT_THAT(complaint("position = [1, 0, nan]" + shape), HasSubstr("within +-1000"));
  EXPECT_THAT(complaint("position = [1, 2]" + shape), HasSubstr("must be three numbers"));
  EXPECT_THAT(complaint("size = 1" + shape), AllOf(StartsWith("test.toml:2: "), HasSubstr("unknown key 'size'")));
  EXPECT_THAT(refusalOf("hill = 3\n"), HasSubstr("[[hill]]"));
}

/// Fails if a scene may have so many hills that every height takes long.
TEST(SceneHills, AreRefusedIfTooMany) {
  std::string most;
  for (std::size_t i = 0; i < kMaxHills; ++i) most += "[[hill]]\nradius = 1\nheight = 0\n";
  EXPECT_EQ(refusalOf(most), "");
  EXPECT_EQ(refusalOf(most + "[[hill]]\n"),
            "test.toml:193: hill: a scene has 64 hills at most; remove this and those that follow");
}

/// Fails if hills that are low enough one by one add up to one that visitors cannot see over.
TEST(SceneHills, AreRefusedIfTooHighTogether) {
  const auto hill = [](const std::string& position, const std::string& shape) {
    return "[[hill]]\nposition = " + position + "\n" + shape + "\n";
  };
  const std::string wide = hill("[0, 0, 0]", "radius = 20\nheight = 1.0");
  EXPECT_EQ(refusalOf(wide + hill("[0, 0, 3]", "radius = 4\nheight = 0.5")), "");
  EXPECT_EQ(refusalOf(wide + hill("[19, 0, 0]", "radius = 1\nheight = 1.5")), "");
  EXPECT_EQ(refusalOf(wide + hill("[1.3, 0, 1.3]", "radius = 1\nheight = 0.7")),
            "test.toml:5: hill: together with others it is higher than 1.6 m, so that visitors cannot see over it; "
            "lower one of them, or move it away")
      << "between the places that are looked at on the first hill";
  EXPECT_THAT(
      refusalOf(hill("[9, 0, 0]", "radius = 10\nheight = 1.5") + "\n" + hill("[0, 0, 0]", "radius = 10\nheight = 1.5")),
      StartsWith("test.toml:1: hill: together"))
      << "between their tops";
  EXPECT_EQ(refusalOf(hill("[0, 0, 0]", "radius = 9\nheight = 0.6") + hill("[0, 0, 0]", "radius = 9\nheight = 0.8") +
                      hill("[0, 0, 0]", "radius = 9\nheight = 0.2")),
            "")
      << "1.6 m, but for rounding";
}

}  // namespace
}  // namespace grove::world
