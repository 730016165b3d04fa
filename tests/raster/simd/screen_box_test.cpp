#include "raster/simd/screen_box.h"

#include <gtest/gtest.h>

#include "raster/box.h"
#include "raster/gl/tile_packer.h"

namespace grove::raster {
namespace {

TEST(ScreenBox, ContainsEveryPointTightly) {
  const Surface stone = makeBox({1.2F, 3.0F, 0.7F}, world::Vec3(0.5F));
  const PointCloud points(stone);
  world::Transform place;
  place.position = {1.0F, 0.0F, -6.0F};
  place.yaw = 0.8F;
  const world::Camera camera;
  const world::Rect max = camera.screenRect(place.apply(stone.bounds()));
  const world::Rect box = screenBox(points, place.matrix(), camera, max);
  for (const Vertex& vertex : stone.vertices) {
    const world::Vec3 at = camera.project(world::Vec3(place.matrix() * world::Vec4(vertex.position, 1.0F)));
    ASSERT_GE(at.x, static_cast<float>(box.left) - 0.01F);
    ASSERT_LE(at.x, static_cast<float>(box.right) + 0.01F);
    ASSERT_GE(at.y, static_cast<float>(box.top) - 0.01F);
    ASSERT_LE(at.y, static_cast<float>(box.bottom) + 0.01F);
  }
  EXPECT_LT(box.width() * box.height(), max.width() * max.height());
}

TEST(ScreenBox, IsTheWholeScreenForPointsBehindTheEye) {
  const PointCloud points(makeBox({1.2F, 3.0F, 0.7F}, world::Vec3(0.5F)));
  const world::Rect max{10, 20, 300, 400};
  EXPECT_EQ(screenBox(points, world::Mat4(1.0F), world::Camera(), max), max);
}

TEST(TilePacker, TilesDoNotOverlapAndAFullAtlasRefuses) {
  TilePacker packer(100, 50);
  EXPECT_EQ(packer.place(60, 30), (world::Rect{0, 0, 60, 30}));
  EXPECT_EQ(packer.place(40, 20), (world::Rect{60, 0, 100, 20}));
  EXPECT_EQ(packer.place(10, 20), (world::Rect{0, 30, 10, 50}));
  EXPECT_EQ(packer.place(100, 1), std::nullopt);
  EXPECT_EQ(packer.place(90, 20), (world::Rect{10, 30, 100, 50}));
  EXPECT_EQ(packer.place(101, 1), std::nullopt);
}

}  // namespace
}  // namespace grove::raster
