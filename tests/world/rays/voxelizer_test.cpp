#include "world/rays/voxelizer.h"

#include <gtest/gtest.h>

#include <numeric>

namespace grove::world {
namespace {

/// A closed box, faces outwards.
Triangles box(Vec3 low, Vec3 high) {
  Triangles result;
  for (int i = 0; i < 8; ++i) {
    result.positions.emplace_back((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                                  (i & 4) != 0 ? high.z : low.z);
  }
  result.indices = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return result;
}

int count(const std::vector<std::uint8_t>& cells) { return std::accumulate(cells.begin(), cells.end(), 0); }

constexpr Cube kCube{{-2.0F, 0.0F, -2.0F}, 4.0F, 32};

TEST(Voxelizer, ABoxHasItsVolumeWithinOneLayerOfCells) {
  const RayScene scene(box({-0.9F, 0.3F, -0.7F}, {0.8F, 1.9F, 1.1F}));
  const int cells = count(voxelize(scene, kCube));
  const float size = kCube.cellSize();
  const auto volume = [&](float grow) { return (1.7F + grow) * (1.6F + grow) * (1.8F + grow) / (size * size * size); };
  EXPECT_GT(static_cast<float>(cells), volume(-size));
  EXPECT_LT(static_cast<float>(cells), volume(size));
}

TEST(Voxelizer, OverlappingBodiesUnite) {
  Triangles both = box({-1.0F, 0.0F, -1.0F}, {0.5F, 1.0F, 1.0F});
  both.append(box({-0.5F, 0.0F, -1.0F}, {1.0F, 1.0F, 1.0F}), Mat4(1.0F));
  EXPECT_EQ(count(voxelize(RayScene(both), kCube)), 16 * 8 * 16);
}

TEST(Voxelizer, AWallThinnerThanACellIsClosed) {
  // Between two layers of cell centres.
  const RayScene scene(box({0.12F, 0.0F, -3.0F}, {0.13F, 5.0F, 3.0F}));
  EXPECT_EQ(count(voxelize(scene, kCube)), 32 * 32);
}

TEST(Voxelizer, GroundPlaneIsNoBody) {
  Triangles plane;
  plane.positions = {{-9.0F, 0.5F, -9.0F}, {9.0F, 0.5F, -9.0F}, {9.0F, 0.5F, 9.0F}, {-9.0F, 0.5F, 9.0F}};
  plane.indices = {{0, 2, 1}, {0, 3, 2}};
  EXPECT_EQ(count(voxelize(RayScene(plane), kCube)), 0);
}

TEST(Voxelizer, EmptyInput) { EXPECT_EQ(count(voxelize(RayScene(Triangles{}), kCube)), 0); }

TEST(SunVisibility, IsDarkBehindABody) {
  const RayScene scene(box({0.5F, 0.0F, -3.0F}, {1.0F, 5.0F, 3.0F}));
  const std::vector<std::uint8_t> visible = sunVisibility(scene, {kCube.low, kCube.size, 8}, {1.0F, 0.0F, 0.0F});
  EXPECT_EQ(visible[0], 0);
  EXPECT_EQ(visible[7], 1);
}

}  // namespace
}  // namespace grove::world
