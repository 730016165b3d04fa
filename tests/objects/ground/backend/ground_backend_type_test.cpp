#include "objects/ground/backend/ground_backend_type.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "node/backend/prepare/load_scene.h"
#include "world/scenes/scene_file.h"

namespace grove::objects::ground {
namespace {

std::shared_ptr<const world::Model> modelOf(const std::string& settings) {
  const world::Scene scene =
      world::parseScene("name = \"test\"\n[[object]]\ntype = \"ground\"\n" + settings, "test.toml");
  return GroundBackendType().model(scene.objects.at(0).parameters);
}

TEST(GroundBackendType, IsBelowEyesAndNoObstacle) {
  const auto model = modelOf("hearth = 3.5\npath = [2.0, 0.0, 9.0]\nseed = 4\n");
  EXPECT_LE(model->bounds().high.y, world::kMaxGroundHeight);
  EXPECT_GE(model->bounds().size().x, 1000.0F);
  EXPECT_EQ(model->solid(), nullptr);
  EXPECT_FALSE(model->obstacleRadius());
}

// Fault: pictures of the ground are cut off at the feet of its hills.
TEST(GroundBackendType, BoundsContainHills) {
  node::BackendTypes types;
  types.add(std::make_unique<GroundBackendType>());
  const auto top = [&](const std::string& scene) {
    return node::loadScene(world::parseScene(scene, "test.toml"), types).layout.objects.at(0).bounds.high.y;
  };
  const std::string ground = "[[object]]\ntype = 'ground'\n";
  EXPECT_LE(top(ground), 0.0F);
  EXPECT_FLOAT_EQ(top(ground + "[[hill]]\nradius = 9\nheight = 0.5\n"), world::kMaxGroundHeight);
}

TEST(GroundBackendType, RefusesBadSettings) {
  EXPECT_THROW((void)modelOf("hearth = -1.0\n"), world::SceneError);
  EXPECT_THROW((void)modelOf("seed = 1000001\n"), world::SceneError);
  EXPECT_THROW((void)modelOf("grass = 1\n"), world::SceneError);
}

}  // namespace
}  // namespace grove::objects::ground
