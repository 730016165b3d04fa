#include "objects/lightfield/bake/near/near_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <span>

namespace grove::bake {
namespace {

using world::Vec3;

/// Two triangles of a model: (0, 1, 2) and (0, 2, 3).
models::Model quadrilateral(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  models::Model model;
  model.materials.resize(2);
  model.triangles.positions = {a, b, c, d};
  model.triangles.indices = {{0, 1, 2}, {0, 2, 3}};
  model.materialOf = {0, 0};
  return model;
}

/// Fails if a face has other corners, or turns over, by which of their edges two triangles share.
TEST(NearFaces, TwoTrianglesOfASquareAreOneFace) {
  for (int first = 0; first < 3; ++first) {
    for (int second = 0; second < 3; ++second) {
      models::Model model = quadrilateral({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
      auto& triangles = model.triangles.indices;
      std::rotate(triangles[0].begin(), triangles[0].begin() + first, triangles[0].end());
      std::rotate(triangles[1].begin(), triangles[1].begin() + second, triangles[1].end());
      const std::vector<ModelFace> faces = facesOf(model);
      ASSERT_EQ(faces.size(), 1U);
      EXPECT_FALSE(faces[0].isTriangle());
      for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(faces[0].corners[(i + 1) % 4], (faces[0].corners[i] + 1) % 4);
    }
  }
}

/// Fails if two triangles are one face that shows another silhouette than theirs.
TEST(NearFaces, BentConcaveAndOtherPairsStayTriangles) {
  const models::Model bent = quadrilateral({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.5F, 0.5F, 0.7F});
  const models::Model concave = quadrilateral({0, 0, 0}, {1, -1, 0}, {0.2F, 0, 0}, {1, 1, 0});
  models::Model materials = quadrilateral({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  materials.materialOf = {0, 1};
  models::Model opposite = quadrilateral({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  opposite.triangles.indices[1] = {2, 0, 3};
  for (const models::Model* const model : std::array<const models::Model*, 4>{&bent, &concave, &materials, &opposite}) {
    const std::vector<ModelFace> faces = facesOf(*model);
    ASSERT_EQ(faces.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_TRUE(faces[i].isTriangle());
      EXPECT_EQ(faces[i].material, model->materialOf[i]);
      EXPECT_TRUE(std::ranges::equal(std::span(faces[i].corners).first(3), model->triangles.indices[i]));
    }
  }
}

/// Fails if triangles without an area, or the last one, get lost.
TEST(NearFaces, AllTrianglesAreInOneFace) {
  models::Model model = quadrilateral({0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0});
  model.triangles.indices.push_back({1, 2, 3});
  model.materialOf.push_back(1);
  EXPECT_EQ(facesOf(model).size(), 3U);
  EXPECT_TRUE(facesOf(models::Model{}).empty());
}

}  // namespace
}  // namespace grove::bake
