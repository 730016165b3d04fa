#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "integration/served_scene.h"
#include "pipeline/embedded.h"

namespace grove::integration {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string complaintAbout(const std::string& text) {
  node::Registry registry;
  objects::registerBuiltinTypes(registry);
  try {
    (void)node::makeLayout(world::parseScene(text, "scene.toml"), registry);
  } catch (const world::SceneError& e) {
    return e.what();
  }
  return "";
}

TEST(BuiltInScene, IsValidAndHasWhatTheReadmePromises) {
  const embedded::File& file = embedded::scenes().front();
  node::Registry registry;
  objects::registerBuiltinTypes(registry);
  const auto layout = node::makeLayout(world::parseScene(file.text(), file.path), registry);
  EXPECT_TRUE(layout.visitor.has_value());
  EXPECT_EQ(layout.lights.size(), 1u);
  for (const char* type : {"sky", "ground", "mesh", "fluid"}) {
    const auto index = registry.find(type);
    ASSERT_TRUE(index.has_value());
    EXPECT_TRUE(std::ranges::any_of(layout.objects, [&](const world::Object& o) { return o.type == *index; })) << type;
  }
}

TEST(Scene, MistakesInATypesOwnSettingsNameLineAndReason) {
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'mesh'\nshape = 'cube'\n"),
              AllOf(HasSubstr("scene.toml:3"), HasSubstr("cube")));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'mesh'\nrenderer = 'vulkan'\n"), HasSubstr("scene.toml:3"));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'fluid'\ngrid = 63\n"), HasSubstr("scene.toml:3"));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'fluid'\ngrid = 4096\n"), HasSubstr("between 16 and 128"));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'teapot'\n"), AllOf(HasSubstr("scene.toml:2"), HasSubstr("teapot")));
}

}  // namespace
}  // namespace grove::integration
