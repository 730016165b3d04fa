#include "objects/ground/backend/ground_backend_type.h"

#include <gtest/gtest.h>

#include <string>

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

TEST(GroundBackendType, RefusesBadSettings) {
  EXPECT_THROW((void)modelOf("hearth = -1.0\n"), world::SceneError);
  EXPECT_THROW((void)modelOf("seed = 1000001\n"), world::SceneError);
  EXPECT_THROW((void)modelOf("grass = 1\n"), world::SceneError);
}

}  // namespace
}  // namespace grove::objects::ground
