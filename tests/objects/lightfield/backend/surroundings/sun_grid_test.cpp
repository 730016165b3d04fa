#include "objects/lightfield/backend/surroundings/sun_grid.h"

#include <gtest/gtest.h>

#include "world/sky.h"

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

class Block final : public world::Model {
 public:
  explicit Block(Vec3 size) : size_(size) {}
  [[nodiscard]] world::Bounds bounds() const override { return {{-size_.x, 0.0F, -size_.z}, size_}; }

 private:
  Vec3 size_;
};

world::ModelledObject objectOf(Vec3 size, const world::Transform& transform) {
  world::ModelledObject object;
  object.transform = transform;
  object.model = std::make_shared<Block>(size);
  object.bounds = transform.apply(object.model->bounds());
  return object;
}

/// A wall across the sun's way, `metres` from the origin, high enough to hide the sun from y < `height` there.
world::Triangles wall(float metres, float height, float halfWidth = 50.0F) {
  const Vec3 sun = world::Sky().sun;
  const Vec3 flat = glm::normalize(Vec3(sun.x, 0.0F, sun.z));
  const Vec3 across(-flat.z, 0.0F, flat.x);
  const float top = height + metres * sun.y / glm::length(Vec3(sun.x, 0.0F, sun.z));
  const Vec3 middle = flat * metres;
  world::Triangles triangles;
  triangles.positions = {middle - across * halfWidth, middle + across * halfWidth,
                         middle + across * halfWidth + Vec3(0, top, 0), middle - across * halfWidth + Vec3(0, top, 0)};
  triangles.indices = {{0, 1, 2}, {0, 2, 3}};
  return triangles;
}

/// Of a layer.
float sunInTheMiddle(const SunGrid& grid, int y) {
  const std::ptrdiff_t row = std::ptrdiff_t{grid.cells[2] / 2} * grid.cells[1] + y;
  return grid.sun[static_cast<std::size_t>(row * grid.cells[0] + grid.cells[0] / 2)];
}

TEST(SunGrid, OpenFieldIsFullySunlit) {
  const SunGrid grid = makeSunGrid(objectOf({2, 1, 2}, {}), world::Sky().sun, world::RayScene(world::Triangles{}));
  EXPECT_TRUE(grid.whole);
  EXPECT_EQ(grid.sun.size(), static_cast<std::size_t>(grid.cells[0] * grid.cells[1] * grid.cells[2]));
}

TEST(SunGrid, WallShadesLowPoints) {
  const SunGrid grid = makeSunGrid(objectOf({1, 4, 1}, {}), world::Sky().sun, world::RayScene(wall(6.0F, 1.5F)));
  EXPECT_FALSE(grid.whole);
  EXPECT_EQ(sunInTheMiddle(grid, 0), 0.0F);
  EXPECT_EQ(sunInTheMiddle(grid, grid.cells[1] - 1), 1.0F);
}

TEST(SunGrid, OwnBodyIsExcluded) {
  EXPECT_TRUE(makeSunGrid(objectOf({3, 4, 3}, {}), world::Sky().sun, world::RayScene(wall(1.0F, 2.0F, 1.0F))).whole);
}

TEST(SunGrid, TurnedAndScaledObject) {
  // The wall's shadow ends at a height of 1.5 m in the world; this object's own metres are two of the world's.
  const world::ModelledObject object = objectOf({1, 4, 1}, {{0, 0, 0}, 2.0F, 2.0F});
  const SunGrid grid = makeSunGrid(object, world::Sky().sun, world::RayScene(wall(9.0F, 1.5F)));
  for (int y = 0; y < grid.cells[1]; ++y) {
    const float height = 2.0F * (static_cast<float>(y) / grid.perMetre.y);
    const float sun = sunInTheMiddle(grid, y);
    if (height < 0.8F) {
      EXPECT_EQ(sun, 0.0F) << height;
    } else if (height > 2.2F) {
      EXPECT_EQ(sun, 1.0F) << height;
    }
  }
}

/// The object's own box, grown about its centre by a factor.
world::Triangles shell(const world::ModelledObject& object, float factor) {
  const world::Bounds box = object.model->bounds();
  world::Triangles triangles;
  for (const Vec3 corner : box.corners()) {
    const Vec3 grown = box.centre() + factor * (corner - box.centre());
    triangles.positions.emplace_back(object.transform.matrix() * world::Vec4(grown, 1.0F));
  }
  triangles.indices = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                       {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  return triangles;
}

// Fault: rays to the sun end elsewhere than at a leaning object's own box, so that it shades itself or others do not.
TEST(SunGrid, LeaningObject) {
  const Vec3 sun = world::Sky().sun;
  const world::Vec2 uphill = glm::normalize(world::Vec2(sun.x, sun.z));
  for (const float steep : {-0.6F, -0.3F, 0.5F}) {
    const world::ModelledObject object = objectOf({3, 4, 2}, {{1, 0.5F, -2}, 1.2F, 1.5F, steep * uphill});
    EXPECT_TRUE(makeSunGrid(object, sun, world::RayScene(shell(object, 0.8F))).whole) << steep;
    for (const float share : makeSunGrid(object, sun, world::RayScene(shell(object, 1.25F))).sun) {
      ASSERT_EQ(share, 0.0F) << steep;
    }
  }
}

}  // namespace
}  // namespace grove::objects::lightfield
