#include "objects/herd/frontend/body/deer_shape.h"

#include <gtest/gtest.h>

#include "objects/herd/poses.h"

namespace grove::objects::herd {
namespace {

using world::Vec3;

class DeerShapeTest : public testing::TestWithParam<Kind> {
 protected:
  const raster::LitSurface deer_ = makeDeer(GetParam());
};

/// Would catch a part that no pose moves, and one of another program's bones.
TEST_P(DeerShapeTest, EachBoneHasVertices) {
  std::array<int, kBones> counts{};
  for (const raster::Vertex& vertex : deer_.surface.vertices) {
    const auto bone = static_cast<std::size_t>(vertex.bone);
    ASSERT_LT(bone, counts.size());
    ++counts[bone];
  }
  for (std::size_t bone = 0; bone < kBones; ++bone) EXPECT_GT(counts[bone], 0) << bone;
  EXPECT_EQ(deer_.light.size(), deer_.surface.vertices.size());
  EXPECT_FALSE(deer_.baked) << "it moves";
}

/// Would catch far animals that cost as much as near ones.
TEST_P(DeerShapeTest, HasLevelsOfDetail) {
  const auto& levels = deer_.surface.levels;
  ASSERT_GE(levels.size(), 3U);
  EXPECT_LT(levels.front().vertexCount, 400U);
  EXPECT_GT(levels.back().vertexCount, 6 * levels.front().vertexCount);
  EXPECT_EQ(levels.back().error, 0.0F);
  for (std::size_t i = 1; i < levels.size(); ++i) {
    EXPECT_LE(levels[i].error, levels[i - 1].error);
    EXPECT_GE(levels[i].vertexCount, levels[i - 1].vertexCount);
  }
}

/// Would catch animals that are cut off at their bounds, or whose legs fly away.
TEST_P(DeerShapeTest, StaysWithinItsBounds) {
  AnimalPose bent = walkingAt({0, 0, 0}, 1.0F);
  bent.posture.bend = 0.3F;
  bent.posture.neckYaw = 0.8F;
  bent.posture.headYaw = 0.5F;
  bent.posture.tail = 1.0F;
  for (const AnimalPose& pose : {standingAt({0, 0, 0}), walkingAt({0, 0, 0}), grazingAt({0, 0, 0}, 2.0F), bent}) {
    const auto bones = bonesOf(pose, 1.0F);
    for (const raster::Vertex& vertex : deer_.surface.vertices) {
      const Vec3 at = Vec3(bones[static_cast<std::size_t>(vertex.bone)] * world::Vec4(vertex.position, 1.0F));
      ASSERT_LT(std::hypot(at.x, at.z), kReach);
      ASSERT_LT(at.y, kTallest);
      ASSERT_GT(at.y, -0.03F);
    }
  }
}

/// Would catch surfaces that are inside out, which would be invisible: normals and triangles point away from the middle
/// of a cross-section. Counts triangles whose direction differs from their normals'.
TEST_P(DeerShapeTest, TrianglesFaceOutwards) {
  const raster::Surface& surface = deer_.surface;
  int wrong = 0;
  for (const auto& [a, b, c] : surface.levels.back().triangles) {
    const Vec3 p = surface.vertices[a].position;
    const Vec3 facing = glm::cross(surface.vertices[b].position - p, surface.vertices[c].position - p);
    const Vec3 normal = surface.vertices[a].normal + surface.vertices[b].normal + surface.vertices[c].normal;
    if (glm::dot(facing, normal) < 0.0F) ++wrong;
  }
  EXPECT_LT(wrong, static_cast<int>(surface.levels.back().triangles.size() / 50));
  double volume = 0.0;
  for (const auto& [a, b, c] : surface.levels.back().triangles) {
    volume += static_cast<double>(
        glm::dot(surface.vertices[a].position, glm::cross(surface.vertices[b].position, surface.vertices[c].position)));
  }
  EXPECT_GT(volume / 6.0, 0.06) << "cubic metres";
}

INSTANTIATE_TEST_SUITE_P(Kinds, DeerShapeTest, testing::Values(Kind::kDoe, Kind::kBuck, Kind::kFawn));

/// Would catch a buck without antlers, or a doe with some.
TEST(DeerKindsTest, OnlyBucksHaveAntlers) {
  const auto heightOf = [](Kind kind) {
    const raster::LitSurface deer = makeDeer(kind);
    float height = 0.0F;
    for (const raster::Vertex& vertex : deer.surface.vertices) {
      if (vertex.bone == static_cast<float>(kHead)) height = std::max(height, vertex.position.y);
    }
    return height;
  };
  EXPECT_GT(heightOf(Kind::kBuck), heightOf(Kind::kDoe) + 0.25F);
  EXPECT_LT(heightOf(Kind::kFawn), heightOf(Kind::kDoe) + 0.05F);
}

}  // namespace
}  // namespace grove::objects::herd
