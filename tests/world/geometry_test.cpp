#include "world/geometry.h"

#include <gtest/gtest.h>

namespace grove::world {
namespace {

TEST(Transform, YawIsCounterClockwise) {
  Transform transform;
  transform.yaw = glm::half_pi<float>();
  transform.position = {10, 0, 0};
  const Vec3 p(transform.matrix() * Vec4(0, 0, -1, 1));
  EXPECT_NEAR(p.x, 9.0F, 1e-5F);
  EXPECT_NEAR(p.z, 0.0F, 1e-5F);
}

TEST(Transform, BoundsContainTheTurnedBox) {
  Transform transform;
  transform.yaw = glm::quarter_pi<float>();
  transform.scale = 2.0F;
  const Bounds turned = transform.apply({{-1, 0, -1}, {1, 1, 1}});
  EXPECT_NEAR(turned.high.x, 2.0F * std::sqrt(2.0F), 1e-5F);
  EXPECT_NEAR(turned.high.y, 2.0F, 1e-5F);
}

/// Fails if what stands on a slope is not upright, or a tile on it does not lie on it.
TEST(Transform, LeansWithTheGround) {
  Transform transform;
  transform.position = {3.0F, 1.0F, -2.0F};
  transform.yaw = 0.8F;
  transform.scale = 2.0F;
  transform.slope = {0.2F, -0.1F};
  const auto placed = [&](Vec3 point) { return Vec3(transform.matrix() * Vec4(point, 1.0F)); };
  EXPECT_EQ(placed(Vec3(0.0F)), transform.position);
  EXPECT_LT(glm::distance(placed({0.0F, 1.0F, 0.0F}), Vec3(3.0F, 3.0F, -2.0F)), 1e-5F);
  for (const Vec3 point : {Vec3(1.0F, 0.0F, 0.0F), Vec3(0.3F, 0.0F, -2.0F)}) {
    const Vec3 there = placed(point);
    EXPECT_NEAR(there.y, 1.0F + 0.2F * (there.x - 3.0F) - 0.1F * (there.z + 2.0F), 1e-5F);
  }
}

/// Fails if a tile on a hillside is cut off where its bounds end.
TEST(Transform, BoundsContainTheLeaningBox) {
  Transform transform;
  transform.position = {5, 1, 0};
  transform.slope = {0.5F, 0.25F};
  const Bounds leaning = transform.apply({{-1, 0, -2}, {1, 1, 2}});
  EXPECT_NEAR(leaning.low.y, 1.0F - 0.5F - 0.5F, 1e-5F);
  EXPECT_NEAR(leaning.high.y, 2.0F + 0.5F + 0.5F, 1e-5F);
}

TEST(Transform, EmptyStaysEmpty) { EXPECT_TRUE(Transform{}.apply(Bounds{}).empty()); }

TEST(Triangles, AppendMovesPositionsAndIndices) {
  Triangles one;
  one.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  one.indices = {{0, 1, 2}};
  Triangles all = one;
  Transform transform;
  transform.position = {0, 0, 5};
  all.append(one, transform.matrix());
  ASSERT_EQ(all.indices.size(), 2u);
  EXPECT_EQ(all.indices[1][2], 5u);
  EXPECT_FLOAT_EQ(all.bounds().high.z, 5.0F);
}

}  // namespace
}  // namespace grove::world
