#include "node/backend/prepare/share_of_scene.h"

#include <gtest/gtest.h>

#include "node/backend/prepare/load_scene.h"
#include "node/boxes.h"

namespace grove::node {
namespace {

LoadedScene threeBoxes() {
  return loadScene(
      world::parseScene("[[object]]\ntype = \"box\"\nname = \"a\"\n[[object]]\ntype = \"box\"\n"
                        "name = \"b\"\n[[object]]\ntype = \"box\"\nname = \"a\"\n[visitor]\ntype = \"box\"\n",
                        "test"),
      testing::boxBackends());
}

std::optional<ServedObjects> named(const LoadedScene& scene, const std::vector<std::string>& names) {
  std::string unknown;
  return namedObjects(scene.layout, names, unknown);
}

TEST(ShareOfScene, SelectsByObjectOrType) {
  const LoadedScene scene = threeBoxes();
  EXPECT_EQ(named(scene, {"a"})->objects, (std::set<world::ObjectId>{1, 3}));
  EXPECT_FALSE(named(scene, {"a"})->visitors);
  EXPECT_EQ(named(scene, {"b", "a"})->objects.size(), 3U);
  EXPECT_EQ(named(scene, {"box"})->objects.size(), 3U);
  EXPECT_TRUE(named(scene, {"box"})->visitors);
  std::string unknown;
  EXPECT_FALSE(namedObjects(scene.layout, std::vector<std::string>{"a", "c"}, unknown));
  EXPECT_EQ(unknown, "c");
}

TEST(ShareOfScene, KeepsTheIdsAndTheWholeLayout) {
  const LoadedScene scene = threeBoxes();
  const LoadedScene share = shareOf(scene, *named(scene, {"b"}));
  ASSERT_EQ(share.objects.size(), 1U);
  EXPECT_EQ(share.objects[0].id, 2U);
  EXPECT_EQ(share.visitor, nullptr);
  EXPECT_EQ(share.layout.objects.size(), 3U);
  EXPECT_TRUE(share.layout.visitor);
  const ServedObjects rest = restOf(scene.layout, *named(scene, {"b"}));
  EXPECT_EQ(rest.objects, (std::set<world::ObjectId>{1, 3}));
  EXPECT_TRUE(rest.visitors);
  EXPECT_TRUE(restOf(scene.layout, *named(scene, {"box"})).empty());
}

TEST(ShareOfScene, ContainsTheDescriptionsOfItsObjects) {
  const world::Scene scene = world::parseScene(
      "name = \"yard\"\n[[object]]\ntype = \"box\"\nname = \"a\"\n[[object]]\ntype = \"box\"\nname = \"b\"\n"
      "[visitor]\ntype = \"box\"\n",
      "test");
  const world::Scene share = shareOf(scene, {.objects = {2}, .visitors = false});
  ASSERT_EQ(share.objects.size(), 1U);
  EXPECT_EQ(share.objects[0].name, "b");
  EXPECT_FALSE(share.visitor);
  EXPECT_EQ(share.name, "yard");
  EXPECT_TRUE(shareOf(scene, {.objects = {}, .visitors = true}).visitor);
}

TEST(ShareOfScene, NamesTheTypeThatNeedsAllModels) {
  const LoadedScene scene = threeBoxes();
  const BackendTypes types = testing::boxBackends();
  const auto needing = [&](const ServedObjects& own) { return typeThatNeedsAllModels(scene.layout, own, types); };
  EXPECT_EQ(needing({.objects = {2}, .visitors = false}), types.find("box"));
  EXPECT_EQ(needing({.objects = {}, .visitors = true}), types.find("box"));
  EXPECT_EQ(needing({}), nullptr);
}

}  // namespace
}  // namespace grove::node
