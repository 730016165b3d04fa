#include "node/backend/prepare/load_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "node/boxes.h"

namespace grove::node {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

LoadedScene load(const std::string& text) {
  return loadScene(world::parseScene(text, "t.toml"), testing::boxBackends());
}

TEST(TypeTable, FindsTypesByName) {
  const BackendTypes types = testing::boxBackends();
  ASSERT_NE(types.find("box"), nullptr);
  EXPECT_EQ(types.find("box")->name(), "box");
  EXPECT_EQ(types.find("sphere"), nullptr);
  EXPECT_THAT(types.names(), ElementsAre("box"));
}

TEST(LoadScene, MakesObjectsWithBoundsInTheWorld) {
  const LoadedScene scene = load("[[object]]\ntype='box'\nsize=2\nobstacle=0.5\nposition=[5,0,0]\nscale=3");
  ASSERT_EQ(scene.objects.size(), 1U);
  EXPECT_NE(scene.objects[0].model, nullptr);
  EXPECT_FLOAT_EQ(scene.objects[0].bounds.low.x, 2.0F);
  EXPECT_FLOAT_EQ(scene.objects[0].bounds.high.x, 8.0F);
  const std::vector<world::Obstacle> obstacles = scene.layout.obstacles();
  ASSERT_EQ(obstacles.size(), 1U);
  EXPECT_EQ(obstacles[0].centre, (world::Vec2{5.0F, 0.0F}));
  EXPECT_FLOAT_EQ(obstacles[0].radius, 1.5F);
}

TEST(LoadScene, LayoutIsTheSameOnEveryNode) {
  const LoadedScene scene = load(R"(
name = "a yard"
radius = 12
[visitor]
type = "box"
size = 4
[[light]]
position = [0, 1, 0]
[[object]]
type = "box"
[[object]]
type = "box"
name = "second"
)");
  const world::Layout& layout = scene.layout;
  EXPECT_EQ(layout.name, "a yard");
  EXPECT_EQ(layout.radius, 12.0F);
  EXPECT_EQ(layout.lights.size(), 1U);
  EXPECT_TRUE(layout.obstacles().empty());
  EXPECT_THAT(layout.types, ElementsAre("box"));
  ASSERT_EQ(layout.objects.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(layout.objects[i].id, scene.objects[i].id);
    EXPECT_EQ(layout.objects[i].type, 0U);
    EXPECT_NE(layout.objects[i].id, 0U);
    EXPECT_LT(layout.objects[i].id, world::kFirstPlayerObject);
  }
  EXPECT_NE(layout.objects[0].id, layout.objects[1].id);
  EXPECT_EQ(layout.objects[1].name, "second");
  ASSERT_TRUE(layout.visitor);
  EXPECT_FLOAT_EQ(layout.visitor->bounds.high.x, 2.0F);
  EXPECT_NE(scene.visitor, nullptr);
}

TEST(LoadScene, UnknownTypesAndKeysNameLineAndChoices) {
  try {
    (void)load("[[object]]\ntype='sphere'");
    FAIL();
  } catch (const world::SceneError& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("t.toml:2"), HasSubstr("'sphere'"), HasSubstr("known: box")));
  }
  EXPECT_THROW((void)load("[[object]]\ntype='box'\nsise=2"), world::SceneError);
}

TEST(LoadScene, OverridesReplaceTypeOptions) {
  const auto greenOf = [](const LoadedScene& scene) { return scene.optionsOf<testing::BoxOptions>("box").green; };
  EXPECT_EQ(greenOf(load("[[object]]\ntype='box'")), 0U);
  EXPECT_EQ(greenOf(load("[types.box]\ngreen = 7")), 7U);
  for (const char* const text : {"[types.box]\ngreen = 7", "name = 'no options'"}) {
    world::Scene scene = world::parseScene(text, "t.toml");
    world::setTypeOption(scene, "box", "green", 9);
    EXPECT_EQ(greenOf(loadScene(scene, testing::boxBackends())), 9U) << text;
  }
}

TEST(LoadScene, BadTypeOptionsNameTheirLine) {
  const auto complaint = [](const std::string& text) -> std::string {
    try {
      (void)load(text);
    } catch (const world::SceneError& e) {
      return e.what();
    }
    return "none";
  };
  EXPECT_THAT(complaint("[types.box]\ngrene = 7"),
              AllOf(HasSubstr("t.toml:2"), HasSubstr("'box'"), HasSubstr("'grene'")));
  EXPECT_THAT(complaint("[types.box]\ngreen = 700"), AllOf(HasSubstr("t.toml:2"), HasSubstr("between 0 and 255")));
  EXPECT_THAT(complaint("[types.sphere]\nred = 1"), AllOf(HasSubstr("t.toml:1"), HasSubstr("'sphere'")));
  EXPECT_THAT(complaint("[types]\nbox = 1"), HasSubstr("t.toml:2"));
  EXPECT_THAT(complaint("types = 1"), HasSubstr("t.toml:1"));
}

/// Would catch a node that opens files of objects which others own.
TEST(LoadScene, LoadsOnlyTheRequestedObjects) {
  const world::Scene scene = world::parseScene(
      "[[object]]\ntype='box'\nsize='wrong'\n[[object]]\ntype='box'\nsize=4\n[visitor]\ntype='box'\nred='wrong'\n",
      "t.toml");
  const LoadedScene loaded = loadScene(scene, testing::boxBackends(), {.objects = {2}, .visitors = false});
  ASSERT_EQ(loaded.objects.size(), 1U);
  EXPECT_EQ(loaded.objects[0].id, 2U);
  EXPECT_FLOAT_EQ(loaded.objects[0].bounds.high.x, 2.0F);
  EXPECT_EQ(loaded.visitor, nullptr);
  EXPECT_EQ(loaded.layout.objects.size(), 2U);
  EXPECT_TRUE(loaded.layout.visitor);
  EXPECT_THROW((void)loadScene(scene, testing::boxBackends()), world::SceneError);
}

}  // namespace
}  // namespace grove::node
