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
