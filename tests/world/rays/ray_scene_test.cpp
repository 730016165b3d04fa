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

/// Fails if rays meet triangles at their own place only, or if normals stay in their coordinates.
TEST(RayScene, HitsTrianglesAtAllTheirPlaces) {
  const auto square = std::make_shared<const Triangles>(floorSquare());
  const Mat4 upright = glm::rotate(Mat4(1.0F), glm::radians(90.0F), Vec3(0, 0, 1));
  const std::vector<PlacedTriangles> placed{
      {square, glm::translate(Mat4(1.0F), Vec3(10, 2, 0))},
      {square, glm::scale(glm::translate(Mat4(1.0F), Vec3(20, 0, 0)), Vec3(3.0F))},
      {square, glm::translate(Mat4(1.0F), Vec3(30, 0, 0)) * upright}};
  const RayScene scene(placed);
  EXPECT_FALSE(scene.occluded({0, 3, 0}, {0, -1, 0})) << "none stands at the origin";
  const auto raised = scene.intersect({10, 3, 0.1F}, {0, -1, 0});
  ASSERT_TRUE(raised);
  EXPECT_NEAR(raised->distance, 1.0F, 1e-5F);
  EXPECT_TRUE(scene.occluded({22.5F, 3, 0}, {0, -1, 0})) << "it is three times as wide";
  const auto wall = scene.intersect({33, 0.1F, 0.2F}, {-1, 0, 0});
  ASSERT_TRUE(wall);
  EXPECT_NEAR(wall->distance, 3.0F, 1e-5F);
  EXPECT_NEAR(std::abs(wall->normal.x), 1.0F, 1e-5F);
}

/// Fails if every place has triangles of its own: a forest of one tree then costs as much as one of many.
TEST(RayScene, KeepsOneCopyForAllPlaces) {
  Triangles many;
  for (int i = 0; i < 1000; ++i) many.append(floorSquare(), glm::translate(Mat4(1.0F), Vec3(i, 0, 0)));
  const auto shared = std::make_shared<const Triangles>(many);
  std::vector<PlacedTriangles> placed;
  placed.reserve(10);
  for (int i = 0; i < 10; ++i) placed.push_back({shared, glm::translate(Mat4(1.0F), Vec3(0, i, 0))});
  EXPECT_LT(RayScene(placed).bytes(), 2 * RayScene(many).bytes());
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
