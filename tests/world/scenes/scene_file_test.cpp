#include "world/scenes/scene_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "base/error.h"

namespace grove::world {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// The message of the SceneError that parsing (and reading the first object's parameters) throws.
std::string complaintAbout(const std::string& text) {
  try {
    const Scene scene = parseScene(text, "test.toml");
    for (const ObjectDescription& object : scene.objects) {
      (void)object.parameters.number("height", 1.0, 0.5, 9.0);
      (void)object.parameters.integer("seed", 1, 0, 100);
      (void)object.parameters.integer("whole", 1, 0, 1'000'000);
      (void)object.parameters.choice("renderer", {"gl", "embree"});
      object.parameters.finish();
    }
  } catch (const SceneError& e) {
    return e.what();
  }
  return "";
}

TEST(SceneFile, ReadsEveryKey) {
  const Scene scene = parseScene(R"(
name = "clearing"
spawn = [1.0, 0, 9]
spawn_yaw_degrees = 90
radius = 25.0
[visitor]
type = "figure"
[[light]]
position = [0, 1, 0]
colour = [1, 0.5, 0.2]
flicker = 0.5
[[object]]
type = "mesh"
name = "stone"
position = [3, 0, 4]
yaw_degrees = 180
scale = 2
height = 3.5
)",
                                 "test.toml");
  EXPECT_EQ(scene.name, "clearing");
  EXPECT_NEAR(scene.spawnYaw, 1.5708F, 1e-3F);
  ASSERT_TRUE(scene.visitor.has_value());
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_FLOAT_EQ(scene.lights[0].flicker, 0.5F);
  ASSERT_EQ(scene.objects.size(), 1u);
  const ObjectDescription& stone = scene.objects[0];
  EXPECT_EQ(stone.type, "mesh");
  EXPECT_FLOAT_EQ(stone.transform.scale, 2.0F);
  EXPECT_DOUBLE_EQ(stone.parameters.number("height", 0, 0, 10), 3.5);
  EXPECT_NO_THROW(stone.parameters.finish());
}

// Fault: copies of an object share a place or a name, or lose its settings.
TEST(SceneFile, CopiesAnObjectToItsPlaces) {
  const Scene scene = parseScene(R"(
[[object]]
type = "mesh"
name = "stone"
position = [7, 0.5, 7]
height = 3.5
places = [
  [1, 2, 90, 1.5],
  [-3.5, 4, -30, 0.5],
]
)",
                                 "test.toml");
  ASSERT_EQ(scene.objects.size(), 2U);
  EXPECT_EQ(scene.objects[0].name, "stone 1");
  EXPECT_EQ(scene.objects[1].name, "stone 2");
  EXPECT_EQ(scene.objects[0].transform.position, Vec3(1.0F, 0.5F, 2.0F));
  EXPECT_EQ(scene.objects[1].transform.position, Vec3(-3.5F, 0.5F, 4.0F));
  EXPECT_NEAR(scene.objects[0].transform.yaw, 1.5708F, 1e-3F);
  EXPECT_FLOAT_EQ(scene.objects[1].transform.scale, 0.5F);
  for (const ObjectDescription& object : scene.objects) {
    EXPECT_DOUBLE_EQ(object.parameters.number("height", 0, 0, 10), 3.5);
    EXPECT_NO_THROW(object.parameters.finish());
  }
}

TEST(SceneFile, RefusesBadPlaces) {
  const auto complaint = [](const std::string& places) {
    return complaintAbout("[[object]]\ntype = 'mesh'\nplaces = " + places + "\n");
  };
  for (const char* const places :
       {"3", "[]", "[1, 2, 3, 4]", "[[1, 2, 3]]", "[[1, 2, 3, 4, 5]]", "[[1, 2, 3, 'x']]", "[[1, 2, 3, inf]]"}) {
    EXPECT_THAT(complaint(places),
                AllOf(StartsWith("test.toml:3: "), HasSubstr("'places' must be a list of lists of 4 numbers")))
        << places;
  }
  for (const char* const places : {"[[1001, 0, 0, 1]]", "[[0, -1001, 0, 1]]", "[[0, 0, 361, 1]]", "[[0, 0, 0, 0]]"}) {
    EXPECT_THAT(complaint(places), AllOf(StartsWith("test.toml:3: "), HasSubstr("'places' has a number out of range")))
        << places;
  }
  EXPECT_THAT(complaint("[\n[0, 0, 0, 1],\n[0, 0, 0],\n]"), StartsWith("test.toml:5: ")) << "the row's line";
  std::string many;
  for (int i = 0; i < 4097; ++i) many += "[0, 0, 0, 1],";
  EXPECT_THAT(complaint("[" + many + "]"), HasSubstr("more than 4096 objects"));
}

/// Fails if trees, fires or visitors stand in a hill or float above the ground.
TEST(SceneFile, EverythingStandsOnHills) {
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
TEST(SceneFile, SkyAndGroundStayAndFluidsAreUpright) {
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
TEST(SceneFile, RefusesBadHills) {
  const auto complaint = [](const std::string& keys) { return complaintAbout("[[hill]]\n" + keys + "\n"); };
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
  EXPECT_THAT(complaintAbout("hill = 3\n"), HasSubstr("[[hill]]"));
}

/// Fails if a scene may have so many hills that every height takes long.
TEST(SceneFile, RefusesTooManyHills) {
  std::string most;
  for (std::size_t i = 0; i < kMaxHills; ++i) most += "[[hill]]\nradius = 1\nheight = 0\n";
  EXPECT_EQ(complaintAbout(most), "");
  EXPECT_EQ(complaintAbout(most + "[[hill]]\n"),
            "test.toml:193: hill: a scene has 64 hills at most; remove this and those that follow");
}

/// Fails if hills that are low enough one by one add up to one that visitors cannot see over.
TEST(SceneFile, RefusesHillsThatAreTooHighTogether) {
  const auto hill = [](const std::string& position, const std::string& shape) {
    return "[[hill]]\nposition = " + position + "\n" + shape + "\n";
  };
  const std::string wide = hill("[0, 0, 0]", "radius = 20\nheight = 1.0");
  EXPECT_EQ(complaintAbout(wide + hill("[0, 0, 3]", "radius = 4\nheight = 0.5")), "");
  EXPECT_EQ(complaintAbout(wide + hill("[19, 0, 0]", "radius = 1\nheight = 1.5")), "");
  EXPECT_EQ(complaintAbout(wide + hill("[1.3, 0, 1.3]", "radius = 1\nheight = 0.7")),
            "test.toml:5: hill: together with others it is higher than 1.6 m, so that visitors cannot see over it; "
            "lower one of them, or move it away")
      << "between the places that are looked at on the first hill";
  EXPECT_THAT(complaintAbout(hill("[9, 0, 0]", "radius = 10\nheight = 1.5") + "\n" +
                             hill("[0, 0, 0]", "radius = 10\nheight = 1.5")),
              StartsWith("test.toml:1: hill: together"))
      << "between their tops";
  EXPECT_EQ(
      complaintAbout(hill("[0, 0, 0]", "radius = 9\nheight = 0.6") + hill("[0, 0, 0]", "radius = 9\nheight = 0.8") +
                     hill("[0, 0, 0]", "radius = 9\nheight = 0.2")),
      "")
      << "1.6 m, but for rounding";
}

TEST(SceneFile, ErrorsNameLineAndReason) {
  EXPECT_THAT(complaintAbout("name = \n"), StartsWith("test.toml:1: "));
  EXPECT_THAT(complaintAbout("\n\nnaem = 'x'\n"), AllOf(StartsWith("test.toml:3: "), HasSubstr("unknown key 'naem'")));
  EXPECT_THAT(complaintAbout("radius = 'wide'\n"), AllOf(StartsWith("test.toml:1: "), HasSubstr("must be a number")));
  EXPECT_THAT(complaintAbout("radius = 0\n"), HasSubstr("must lie between 1 and 500"));
  EXPECT_THAT(complaintAbout("radius = nan\n"), HasSubstr("must lie between"));
  EXPECT_THAT(complaintAbout("spawn = [1, 2]\n"), HasSubstr("must be three numbers"));
  EXPECT_THAT(complaintAbout("spawn = [1, 2, inf]\n"), HasSubstr("within +-1000"));
  EXPECT_THAT(complaintAbout("object = 3\n"), HasSubstr("[[object]]"));
  EXPECT_THAT(complaintAbout("visitor = 3\n"), HasSubstr("[visitor]"));
  EXPECT_THAT(complaintAbout("[[object]]\nname = 'a'\n"),
              AllOf(HasSubstr("object 'a'"), HasSubstr("'type' is missing")));
  EXPECT_THAT(complaintAbout("[[light]]\nflicker = 2\n"), AllOf(StartsWith("test.toml:2: "), HasSubstr("flicker")));
}

TEST(SceneFile, ChecksKeysOfTypes) {
  EXPECT_EQ(complaintAbout("[[object]]\ntype = 'mesh'\nheight = 2\n"), "");
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'mesh'\nheight = 99\n"),
              AllOf(StartsWith("test.toml:3: "), HasSubstr("height")));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'mesh'\nseed = 1.5\n"), HasSubstr("must be a whole number"));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'mesh'\nseed = 9223372036854775807\n"),
              AllOf(StartsWith("test.toml:3: "), HasSubstr("'seed' must lie between 0 and 100")));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'mesh'\nheight = 9223372036854775807\n"),
              AllOf(StartsWith("test.toml:3: "), HasSubstr("'height' must lie between 0.5 and 9")));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'mesh'\nposition = [0, -9223372036854775808, 0]\n"),
              AllOf(StartsWith("test.toml:3: "), HasSubstr("within +-1000")));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'mesh'\nwhole = 1000001\n"), HasSubstr("between 0 and 1000000"))
      << "every digit of a large bound";
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'mesh'\n\nrenderer = 'vulkan'\n"),
              AllOf(StartsWith("test.toml:4: "), HasSubstr("'gl', 'embree'")));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'mesh'\nhieght = 2\n"), HasSubstr("unknown key 'hieght'"));
}

TEST(SceneFile, MissingFileNamesTheRemedy) {
  try {
    (void)loadScene("no/such/scene.toml");
    FAIL();
  } catch (const EnvironmentError& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("no/such/scene.toml"), HasSubstr("--scene")));
  }
}

std::string repeated(int count, const std::string& text) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

TEST(SceneFile, RefusesDeepNesting) {
  constexpr int kDeep = 50'000;
  const std::string name = "a" + repeated(kDeep, ".a");
  for (const std::string& scene : {name + " = 1\n", "[" + name + "]\n", "[[" + name + "]]\n",
                                   "x = " + repeated(kDeep, "[") + repeated(kDeep, "]") + "\n",
                                   "x = " + repeated(kDeep, "{a = ") + "1" + repeated(kDeep, "}") + "\n"}) {
    EXPECT_THAT(complaintAbout("name = 'deep'\n" + scene), AllOf(StartsWith("test.toml:2: "), HasSubstr("nested")));
  }
}

TEST(SceneFile, RefusesIrregularFiles) {
  const std::filesystem::path fifo =
      std::filesystem::path(testing::TempDir()) / ("grove_scene_fifo_" + std::to_string(getpid()));
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  for (const std::filesystem::path& file : {std::filesystem::path("/dev/zero"), std::filesystem::path("/tmp"), fifo}) {
    try {
      (void)loadScene(file);
      ADD_FAILURE() << file;
    } catch (const EnvironmentError& e) {
      EXPECT_THAT(e.what(), AllOf(StartsWith(file.string()), HasSubstr("is not a regular file"), HasSubstr("--scene")));
    }
  }
  std::filesystem::remove(fifo);
}

TEST(SceneFile, AnEmptyFileIsAnEmptyWorld) { EXPECT_TRUE(parseScene("", "test.toml").objects.empty()); }

}  // namespace
}  // namespace grove::world
