#include "objects/lightfield/backend/voxel_shapes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "world/rays/ray_scene.h"

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

/// A trunk of 2 x 2 cells of 0.1 m up to 2 m, below a crown of leaves of 4 x 4 cells up to 2.4 m.
class VoxelShapes : public testing::Test {
 protected:
  static constexpr int kWidth = 4;
  static constexpr int kHeight = 24;
  VoxelShapes() {
    for (int z = 0; z < kWidth; ++z) {
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          const bool inTrunk = x >= 1 && x <= 2 && z >= 1 && z <= 2 && y < 20;
          const Voxel kind = inTrunk ? Voxel::kWood : y >= 20 ? Voxel::kLeaves : Voxel::kEmpty;
          cells_.push_back(static_cast<std::uint8_t>(kind));
        }
      }
    }
    grid_ = {kWidth, kHeight, kWidth, 0.1F, {-0.2F, 0.0F, -0.2F}, cells_};
  }

  std::vector<std::uint8_t> cells_;
  VoxelGrid grid_;
};

float signedVolume(const world::Triangles& triangles) {
  float volume = 0.0F;
  for (const auto& [a, b, c] : triangles.indices) {
    volume += glm::dot(triangles.positions[a], glm::cross(triangles.positions[b], triangles.positions[c])) / 6.0F;
  }
  return volume;
}

TEST_F(VoxelShapes, WoodSurfaceIsClosed) {
  const world::Triangles wood = woodSurface(grid_);
  // 80 outer sides of cells up the trunk's four faces of 2 x 20, and two ends of 2 x 2: two triangles each.
  EXPECT_EQ(wood.indices.size(), 2U * (4 * 2 * 20 + 2 * 4));
  EXPECT_NEAR(signedVolume(wood), 0.2F * 0.2F * 2.0F, 1e-5F);
  const world::Bounds bounds = wood.bounds();
  EXPECT_NEAR(bounds.low.x, -0.1F, 1e-6F);
  EXPECT_NEAR(bounds.high.y, 2.0F, 1e-5F);
}

TEST_F(VoxelShapes, LeavesShadePartially) {
  const world::Triangles shade = shadeSurface(grid_);
  EXPECT_EQ(shade.indices.size(), woodSurface(grid_).indices.size() + 2U * 4 * 4 * 4);
  const world::RayScene rays(shade);
  int hidden = 0;
  constexpr int kRays = 2000;
  for (int i = 0; i < kRays; ++i) {
    const float x = 0.4F * std::fmod(0.618034F * static_cast<float>(i), 1.0F) - 0.2F;
    const float z = 0.4F * std::fmod(0.754878F * static_cast<float>(i), 1.0F) - 0.2F;
    hidden += rays.occluded({x, 5.0F, z}, {0.0F, -1.0F, 0.0F}, 0.0F, 2.9F) ? 1 : 0;
  }
  EXPECT_GT(hidden, kRays / 2);
  EXPECT_LT(hidden, kRays);
}

TEST_F(VoxelShapes, TrunkIsTheObstacle) {
  const auto radius = trunkRadius(grid_);
  ASSERT_TRUE(radius.has_value());
  EXPECT_NEAR(*radius, std::sqrt(0.04F / 3.1415927F), 1e-5F);
}

TEST_F(VoxelShapes, WithoutWoodNoObstacle) {
  const std::vector<std::uint8_t> leaves(64, static_cast<std::uint8_t>(Voxel::kLeaves));
  const VoxelGrid bush{4, 4, 4, 0.5F, {-1.0F, 0.0F, -1.0F}, leaves};
  EXPECT_FALSE(trunkRadius(bush).has_value());
  EXPECT_TRUE(woodSurface(bush).indices.empty());
  EXPECT_FALSE(trunkRadius({}).has_value());
  EXPECT_TRUE(shadeSurface({}).indices.empty());
}

}  // namespace
}  // namespace grove::objects::lightfield
