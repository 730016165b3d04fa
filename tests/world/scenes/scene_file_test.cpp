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
