#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <set>
#include <string_view>

#include "cli/prepare/prepare_world.h"
#include "integration/served_scene.h"
#include "objects/lightfield/backend/light_field_model.h"
#include "objects/lightfield/file/small_field.h"
#include "pipeline/embedded.h"
#include "sanitized.h"

namespace grove::integration {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string complaintAbout(const std::string& text) {
  try {
    (void)node::loadScene(world::parseScene(text, "scene.toml"), objects::builtinBackends());
  } catch (const world::SceneError& e) {
    return e.what();
  }
  return "";
}

/// The built-in scene with light fields of a few small views, which are baked in seconds; under a sanitizer all its
/// plants are of one kind.
std::string coarseBuiltInScene() {
  std::string text(embedded::scenes().front().text());
  const std::string ofForest = "size = 512\nsubdivision = 6\n";
  for (std::size_t at = 0; (at = text.find(ofForest, at)) != std::string::npos;) text.erase(at, ofForest.size());
  std::string coarse;
  for (std::size_t from = 0;;) {
    const std::size_t plant = text.find("plant = ", from);
    coarse += text.substr(from, plant - from);
    if (plant == std::string::npos) return coarse;
    coarse += "subdivision = 2\nsize = 32\n";
    from = text.find('\n', plant);
    coarse += kSanitized ? "plant = 'fern'" : text.substr(plant, from - plant);
  }
}

TEST(BuiltInScene, MatchesTheReadme) {
  const objects::lightfield::TemporaryFolder folder;
  ASSERT_EQ(setenv("GROVE_CACHE", folder.path().c_str(), 1), 0);
  const world::Scene scene = world::parseScene(coarseBuiltInScene(), "grove.toml");
  cli::Progress progress;
  const node::BackendTypes types = objects::builtinBackends();
  ASSERT_TRUE(cli::prepareWorld(scene, types, progress, {}));
  const node::LoadedScene loaded = node::loadScene(scene, types);
  const world::Layout& layout = loaded.layout;
  EXPECT_TRUE(layout.visitor.has_value());
  EXPECT_EQ(layout.lights.size(), 1u);
  EXPECT_GE(layout.objects.size(), 40u);
  for (const char* type : {"sky", "ground", "mesh", "fluid", "lightfield"}) {
    const auto isIts = [&](const world::Object& object) { return layout.types[object.type] == type; };
    EXPECT_TRUE(std::ranges::any_of(layout.objects, isIts)) << type;
  }
  // One sun: every light field stands under one of the suns that it was baked with.
  for (const world::ModelledObject& object : loaded.objects) {
    if (layout.types[object.type] != "lightfield") continue;
    const auto& field = static_cast<const objects::lightfield::LightFieldModel&>(*object.model).shown()->field;
    const double step = 360.0 / field.lightings();
    const double degrees = glm::degrees(static_cast<double>(object.transform.yaw));
    EXPECT_NEAR(std::remainder(degrees, step), 0.0, 1e-3) << object.name;
  }
  // What is prepared once is not prepared again.
  const auto file = std::filesystem::directory_iterator(folder.path() / "light-fields")->path();
  const auto time = std::filesystem::last_write_time(file);
  ASSERT_TRUE(cli::prepareWorld(scene, types, progress, {}));
  EXPECT_EQ(std::filesystem::last_write_time(file), time);
}

TEST(BuiltInScene, StoppedPreparationLeavesNoPartialFiles) {
  const objects::lightfield::TemporaryFolder folder;
  ASSERT_EQ(setenv("GROVE_CACHE", folder.path().c_str(), 1), 0);
  std::stop_source stop;
  stop.request_stop();
  cli::Progress progress;
  EXPECT_FALSE(cli::prepareWorld(world::parseScene(coarseBuiltInScene(), "grove.toml"), objects::builtinBackends(),
                                 progress, stop.get_token()));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
    EXPECT_NE(entry.path().extension(), ".glf") << entry.path();
  }
}

/// Fails if each of many plants is sketched before the world opens, or if one keeps another's look when it has its own.
TEST(Scene, ManyLightFieldsShareRoughOnesAtFirst) {
  const objects::lightfield::TemporaryFolder folder;
  ASSERT_EQ(setenv("GROVE_CACHE", folder.path().c_str(), 1), 0);
  std::string text;
  for (int seed = 1; seed <= 9; ++seed) {
    text += "[[object]]\ntype = 'lightfield'\nplant = 'fern'\nlightings = 1\nsubdivision = 2\nsize = 32\nseed = " +
            std::to_string(seed) + "\nposition = [" + std::to_string(seed) + ", 0, 0]\n";
  }
  const world::Scene scene = world::parseScene("spawn = [0, 0, 0]\n" + text, "scene.toml");
  const node::BackendTypes types = objects::builtinBackends();
  const auto left = cli::prepareFirstLook(scene, types, [](std::string_view, float) {}, {});
  ASSERT_TRUE(left);
  ASSERT_EQ(left->size(), 9u);
  using std::filesystem::directory_iterator;
  EXPECT_EQ(std::distance(directory_iterator(folder.path() / "light-fields"), {}), 1);
  const node::LoadedScene loaded = node::loadScene(scene, types);
  const auto fieldOf = [&](std::size_t object) {
    return static_cast<const objects::lightfield::LightFieldModel&>(*loaded.objects[object].model).shown();
  };
  const auto storages = [&] {
    std::set<const void*> all;
    for (std::size_t i = 0; i < loaded.objects.size(); ++i) all.insert(fieldOf(i)->field.storage.get());
    return all.size();
  };
  EXPECT_EQ(storages(), 1u);
  // The other may be larger.
  EXPECT_GT(fieldOf(8)->field.bounds.high.y, fieldOf(0)->field.bounds.high.y);
  ASSERT_TRUE(left->front()->make([](std::string_view, float) {}, {}));
  ASSERT_TRUE(left->front()->show());
  EXPECT_EQ(storages(), 2u);
}

TEST(Scene, TypeSettingErrorsNameLineAndReason) {
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'mesh'\nshape = 'cube'\n"),
              AllOf(HasSubstr("scene.toml:3"), HasSubstr("cube")));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'mesh'\nrenderer = 'vulkan'\n"), HasSubstr("scene.toml:3"));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'fluid'\ngrid = 63\n"), HasSubstr("scene.toml:3"));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'fluid'\ngrid = 4096\n"), HasSubstr("between 16 and 128"));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'lightfield'\n"), HasSubstr("scene.toml:1"));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'lightfield'\nplant = 'cactus'\n"),
              AllOf(HasSubstr("scene.toml:3"), HasSubstr("oak")));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'lightfield'\nplant = 'oak'\nsubdivision = 129\n"),
              HasSubstr("scene.toml:4"));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'lightfield'\nplant = 'oak'\nsize = 100\n"),
              HasSubstr("power of two"));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'lightfield'\nfile = '/nowhere.glf'\n"),
              AllOf(HasSubstr("scene.toml:3"), HasSubstr("/nowhere.glf")));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'lightfield'\nfile = 'CMakeLists.txt'\nplant = 'oak'\n"),
              HasSubstr("one of"));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'mesh'\nmodel = '/nowhere.glb'\n"), HasSubstr("scene.toml:3"));
  EXPECT_THAT(complaintAbout("[[object]]\ntype = 'teapot'\n"), AllOf(HasSubstr("scene.toml:2"), HasSubstr("teapot")));
}

}  // namespace
}  // namespace grove::integration
