#include "objects/sky/backend/sky_backend_type.h"

#include <gtest/gtest.h>

#include <string>

#include "world/scenes/scene_file.h"

namespace grove::objects::sky {
namespace {

std::shared_ptr<const world::Model> modelOf(const std::string& settings) {
  const world::Scene scene = world::parseScene("name = \"test\"\n[[object]]\ntype = \"sky\"\n" + settings, "test.toml");
  return SkyBackendType().model(scene.objects.at(0).parameters);
}

TEST(SkyBackendType, IsVisibleEverywhereAndNoObstacle) {
  const auto model = modelOf("seed = 12\n");
  EXPECT_TRUE((world::Camera{.pose = {.position = {30, 1.7F, -30}, .yaw = 2.0F}}).sees(model->bounds()));
  EXPECT_EQ(model->solid(), nullptr);
  EXPECT_FALSE(model->obstacleRadius());
}

TEST(SkyBackendType, RefusesBadSettings) {
  EXPECT_THROW((void)modelOf("seed = -1\n"), world::SceneError);
  EXPECT_THROW((void)modelOf("sead = 1\n"), world::SceneError);
}

}  // namespace
}  // namespace grove::objects::sky
