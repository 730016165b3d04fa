#include "objects/lightfield/bake/near/near_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "objects/lightfield/bake/models.h"
#include "world/light.h"

namespace grove::bake {
namespace {

using objects::lightfield::kClusterAlignment;
using objects::lightfield::kMaxClusterVertices;
using objects::lightfield::NearCluster;
using objects::lightfield::NearFace;
using world::Vec3;

/// The surface of a model whose every point gets the light `front` on its front and `back` on its back, in the second
/// of two lightings; none in the first.
NearSurface surfaceOf(const models::Model& model, float front, float back) {
  const LightPoints points = chooseLightPoints(model, {}, 0.1F);
  SurfaceLight light(points.points.size(), 2);
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    const auto values = light.at(i);
    std::fill_n(values.begin() + 3, 3, front);
    std::fill_n(values.begin() + 9, 3, back);
  }
  return makeNearSurface(model, points, light);
}

/// Fails if a side gets the other one's light, or transmitted light as reflected.
TEST(NearSurface, LeavesHaveAColourPerSideAndLighting) {
  models::Model model;
  const std::uint16_t leaf =
      addMaterial(model, {.name = "leaf", .albedo = Vec3(0.5F, 0.25F, 0.1F), .transmittance = Vec3(0.1F, 0.2F, 0.3F)});
  addQuad(model, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, leaf);
  const NearSurface surface = surfaceOf(model, 0.2F, 0.6F);
  ASSERT_EQ(surface.clusters.size(), 1U);
  EXPECT_EQ(surface.clusters[0].smooth, 0U);
  ASSERT_EQ(surface.colours.size(), 2U);
  ASSERT_EQ(surface.colours[1].size(), 2U);
  EXPECT_EQ(surface.colours[0][0], 0xFF000000U);
  EXPECT_EQ(surface.colours[1][0], world::toDisplayRgba({0.16F, 0.17F, 0.2F}));
  EXPECT_EQ(surface.colours[1][1], world::toDisplayRgba({0.32F, 0.19F, 0.12F}));
}

/// Fails if triangles get lost, change their place, or leave their cluster's box.
TEST(NearSurface, ClustersHoldAllTriangles) {
  models::Model model = crookedTree();
  for (int i = 0; i < 500; ++i) {
    const auto f = static_cast<float>(i);
    addQuad(model, {0.01F * f, 2.0F, 0.02F * f}, {0.1F, 0, 0}, {0, 0.1F, 0}, 1);
  }
  const NearSurface surface = surfaceOf(model, 1.0F, 1.0F);
  EXPECT_GE(surface.clusters.size(), 5U);
  Vec3 sum(0.0F);
  std::size_t triangles = 0;
  for (const NearCluster& cluster : surface.clusters) {
    EXPECT_LE(cluster.vertices, kMaxClusterVertices);
    EXPECT_EQ(cluster.firstVertex % kClusterAlignment, 0U);
    for (std::size_t i = 0; i < cluster.faces; ++i) {
      const NearFace& face = surface.faces[cluster.firstFace + i];
      const bool isTriangle = face[2] == face[3];
      triangles += isTriangle ? 1 : 2;
      for (const std::size_t corner :
           isTriangle ? std::vector<std::size_t>{0, 1, 2} : std::vector<std::size_t>{0, 1, 2, 0, 2, 3}) {
        const std::size_t vertex = cluster.firstVertex + face[corner];
        ASSERT_LT(vertex, cluster.firstVertex + cluster.vertices);
        for (int axis = 0; axis < 3; ++axis) {
          const auto a = static_cast<std::size_t>(axis);
          const float place = surface.positions[a][vertex];
          ASSERT_GE(place, cluster.low[a]);
          ASSERT_LE(place, cluster.high[a]);
          sum[axis] += place;
        }
      }
    }
  }
  EXPECT_EQ(triangles, model.triangles.indices.size());
  Vec3 expected(0.0F);
  for (const auto& triangle : model.triangles.indices) {
    for (const std::uint32_t corner : triangle) expected += model.triangles.positions[corner];
  }
  EXPECT_LT(glm::distance(sum, expected), 1.0e-3F * glm::length(expected));
}

/// Fails if wood is drawn with a colour per triangle, whose facets would be seen.
TEST(NearSurface, WoodIsSmooth) {
  models::Model model;
  addBox(model, Vec3(0.0F), Vec3(1.0F), addMaterial(model, whiteStone()));
  const NearSurface surface = surfaceOf(model, 1.0F, 1.0F);
  ASSERT_EQ(surface.clusters.size(), 1U);
  EXPECT_EQ(surface.clusters[0].smooth, 1U);
  EXPECT_EQ(surface.colours[1].size(), 2 * surface.clusters[0].vertices);
}

/// Fails if a model is shown without its textures.
TEST(NearSurface, TexturesHaveNone) {
  models::Model model = crookedTree();
  model.textures.push_back({1, 1, {0xFFFFFFFFU}});
  EXPECT_TRUE(makeNearSurface(model, {}, SurfaceLight(0, 1)).model().empty());
}

}  // namespace
}  // namespace grove::bake
