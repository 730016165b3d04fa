#include "world/rays/ray_scene.h"

#include <gtest/gtest.h>

namespace grove::world {
namespace {

Triangles floorSquare() {
  Triangles t;
  t.positions = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
  t.indices = {{0, 2, 1}, {0, 3, 2}};
  return t;
}

TEST(RayScene, HitsTheNearestSurface) {
  const RayScene scene(floorSquare());
  const auto hit = scene.intersect({0.2F, 3, 0.1F}, {0, -1, 0});
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->distance, 3.0F, 1e-5F);
  EXPECT_NEAR(std::abs(hit->normal.y), 1.0F, 1e-5F);
  EXPECT_FALSE(scene.intersect({2, 3, 0}, {0, -1, 0}).has_value());
}

TEST(RayScene, OcclusionObeysTheInterval) {
  const RayScene scene(floorSquare());
  EXPECT_TRUE(scene.occluded({0, 3, 0}, {0, -1, 0}));
  EXPECT_FALSE(scene.occluded({0, 3, 0}, {0, -1, 0}, 0.0F, 2.0F));
  EXPECT_FALSE(scene.occluded({0, 3, 0}, {0, -1, 0}, 3.5F));
}

TEST(RayScene, StopsBuildingWhenProgressThrows) {
  Triangles many;
  for (int i = 0; i < 20'000; ++i) many.append(floorSquare(), glm::translate(Mat4(1.0F), Vec3(i, i % 7, i % 13)));
  int reported = 0;
  const auto count = [&](float share) {
    ++reported;
    EXPECT_GE(share, 0.0F);
    EXPECT_LE(share, 1.0F);
  };
  const RayScene whole(many, count);
  EXPECT_GT(reported, 1);
  EXPECT_TRUE(whole.occluded({0, 3, 0}, {0, -1, 0}));
  int toldBefore = 0;
  const auto stop = [&](float) {
    ++toldBefore;
    throw std::runtime_error("not wanted");
  };
  EXPECT_THROW(const RayScene half(many, stop), std::runtime_error);
  EXPECT_EQ(toldBefore, 1) << "nothing is told after that";
}

TEST(RayScene, ReportsItsMemory) {
  Triangles many;
  for (int i = 0; i < 1000; ++i) many.append(floorSquare(), glm::translate(Mat4(1.0F), Vec3(i, 0, 0)));
  const std::size_t few = RayScene(floorSquare()).bytes();
  const std::size_t all = RayScene(many).bytes();
  EXPECT_GT(all, few);
  EXPECT_GT(all, many.bytes() / 2) << "it has a copy of them";
  EXPECT_LT(all, 20 * many.bytes());
}

TEST(RayScene, EmptySceneIsValid) {
  const RayScene scene(Triangles{});
  EXPECT_FALSE(scene.occluded({0, 0, 0}, {0, 1, 0}));
}

}  // namespace
}  // namespace grove::world
