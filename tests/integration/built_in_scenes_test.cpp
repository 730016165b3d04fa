#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/error.h"
#include "cli/prepare/prepare_world.h"
#include "objects/builtin.h"
#include "objects/lightfield/backend/light_field_source.h"
#include "world/scenes/scene_layout.h"

namespace grove::integration {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// The files of a scene's light fields, each once.
std::set<std::filesystem::path> fieldsOf(const world::Scene& scene) {
  std::set<std::filesystem::path> files;
  models::FileNames names;
  for (const world::ObjectDescription& object : scene.objects) {
    if (object.type != "lightfield") continue;
    files.insert(objects::lightfield::readSource(object.parameters, names).file);
  }
  return files;
}

class BuiltInScenes : public testing::TestWithParam<const char*> {
 protected:
  const world::Scene scene = cli::openScene(GetParam());
};

INSTANTIATE_TEST_SUITE_P(All, BuiltInScenes, testing::Values("grove", "clearing", "vale"),
                         [](const auto& about) { return std::string(about.param); });

/// Fails if a scene has an unknown type, or two objects that nobody can tell apart (`grove node --objects NAME`).
TEST_P(BuiltInScenes, HaveObjectsWithNamesOfTheirOwn) {
  const auto types = objects::builtinTypes();
  const world::Layout layout = world::layoutOf(scene, types.frontends.names());
  std::set<std::string> names;
  std::set<world::ObjectId> ids;
  for (const world::Object& object : layout.objects) {
    EXPECT_FALSE(object.name.empty());
    EXPECT_TRUE(names.insert(object.name).second) << object.name;
    EXPECT_TRUE(ids.insert(object.id).second) << object.name;
  }
  EXPECT_TRUE(layout.visitor.has_value());
  EXPECT_FALSE(layout.lights.empty());
}

/// Fails if visitors arrive outside their world, in a stone, or in a trunk.
TEST_P(BuiltInScenes, ReceiveVisitorsInTheOpen) {
  const auto place = [](world::Vec3 at) { return world::Vec2(at.x, at.z); };
  EXPECT_LT(glm::length(place(scene.spawn)), 0.8F * scene.radius);
  for (const world::ObjectDescription& object : scene.objects) {
    const bool isTile = object.transform.position.y - scene.spawn.y > 0.01F;
    if ((object.type != "mesh" && object.type != "lightfield") || isTile) continue;
    EXPECT_GT(glm::distance(place(object.transform.position), place(scene.spawn)), 2.0F) << object.name;
  }
}

/// Fails if the edge of the forest, which looks right from afar only, comes near to where visitors walk.
TEST_P(BuiltInScenes, KeepVisitorsAwayFromTheForest) {
  for (const world::ObjectDescription& object : scene.objects) {
    if (object.parameters.text("plant", "") != "copse") continue;
    const world::Vec3 at = object.transform.position;
    EXPECT_GT(glm::length(world::Vec2(at.x, at.z)) - 9.5F * object.transform.scale, scene.radius) << object.name;
  }
}

/// Fails if the large scene is no test of scale, or the small one none for small machines.
TEST(BuiltInScene, SizesDiffer) {
  const world::Scene vale = cli::openScene("vale");
  EXPECT_GE(vale.objects.size(), 500u);
  EXPECT_GE(fieldsOf(vale).size(), 40u);
  EXPECT_LE(fieldsOf(cli::openScene("clearing")).size(), 5u);
}

/// Fails if the order in which scenes are embedded decides what `grove serve` shows.
TEST(BuiltInScene, DefaultIsTheGrove) {
  EXPECT_EQ(cli::openScene(std::nullopt).hash, cli::openScene("grove").hash);
  EXPECT_THAT(cli::aboutScene(), HasSubstr("default: grove"));
}

/// Fails if a misspelt name is reported as a missing file alone.
TEST(BuiltInScene, UnknownNamesAreRefusedWithTheList) {
  try {
    (void)cli::openScene("vail");
    FAIL() << "no such scene";
  } catch (const EnvironmentError& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("vail"), HasSubstr("grove, clearing, vale"), Not(HasSubstr("\n"))));
  }
}

}  // namespace
}  // namespace grove::integration
