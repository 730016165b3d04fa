#include "node/registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "node/boxes.h"

namespace grove::node {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Registry withBoxes() {
  Registry registry;
  registry.add(std::make_unique<testing::BoxType>(std::make_shared<testing::BoxControls>()));
  return registry;
}

TEST(Registry, FindsTypesByName) {
  const Registry registry = withBoxes();
  EXPECT_EQ(registry.find("box"), 0u);
  EXPECT_FALSE(registry.find("sphere").has_value());
}

TEST(Registry, MakesObjectsWithBoundsInTheWorld) {
  const auto layout =
      makeLayout(world::parseScene("[[object]]\ntype='box'\nsize=2\nposition=[5,0,0]\nscale=3", "t"), withBoxes());
  ASSERT_EQ(layout.objects.size(), 1u);
  EXPECT_FLOAT_EQ(layout.objects[0].bounds.low.x, 2.0F);
  EXPECT_FLOAT_EQ(layout.objects[0].bounds.high.x, 8.0F);
  EXPECT_NE(layout.objects[0].id, 0u);
}

TEST(Registry, UnknownTypesAndKeysNameLineAndChoices) {
  try {
    (void)makeLayout(world::parseScene("[[object]]\ntype='sphere'", "t.toml"), withBoxes());
    FAIL();
  } catch (const world::SceneError& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("t.toml:2"), HasSubstr("'sphere'"), HasSubstr("known: box")));
  }
  EXPECT_THROW((void)makeLayout(world::parseScene("[[object]]\ntype='box'\nsise=2", "t.toml"), withBoxes()),
               world::SceneError);
}

}  // namespace
}  // namespace grove::node
