#include "objects/mesh/backend/shapes/holes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "objects/mesh/backend/shapes/model_surface.h"

namespace grove::objects::mesh {
namespace {

using testing::HasSubstr;
using world::Vec3;

constexpr int kTexels = 64;

/// A plate of 2 m x 2 m in the plane z = 0, whose texture is transparent outside of a disc of 1 m around its middle,
/// and a stone beside it.
models::Model disc(std::uint32_t inside, std::uint32_t outside) {
  models::Model model;
  model.name = "disc";
  model.textures.push_back({kTexels, kTexels, {}});
  for (int y = 0; y < kTexels; ++y) {
    for (int x = 0; x < kTexels; ++x) {
      const float away = std::hypot(static_cast<float>(x) - 31.5F, static_cast<float>(y) - 31.5F);
      model.textures[0].texels.push_back(away < 0.25F * kTexels ? inside : outside);
    }
  }
  model.materials.push_back({.name = "stone", .solid = true});
  model.materials.push_back({.name = "leaf", .texture = 0, .alphaCutoff = 0.5F});
  model.triangles.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {3, 0, 0}, {4, 0, 0}, {3, 1, 0}};
  model.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {0, 1}};
  model.normals.assign(7, Vec3(0, 0, 1));
  model.triangles.indices = {{0, 1, 2}, {4, 5, 6}, {0, 2, 3}};
  model.materialOf = {1, 0, 1};
  return model;
}

/// Square metres of a material.
float areaOf(const models::Model& model, std::uint16_t material) {
  float area = 0.0F;
  for (std::size_t i = 0; i < model.triangles.indices.size(); ++i) {
    const auto& [a, b, c] = model.triangles.indices[i];
    const std::vector<Vec3>& p = model.triangles.positions;
    if (model.materialOf[i] == material) area += 0.5F * glm::cross(p[b] - p[a], p[c] - p[a]).z;
  }
  return area;
}

std::string warningOf(const models::Model& model) {
  testing::internal::CaptureStderr();
  (void)withHolesCut(model);
  return testing::internal::GetCapturedStderr();
}

TEST(Holes, AreCutOut) {
  const models::Model cut = withHolesCut(disc(0xFF00FF00U, 0x0000FF00U));
  EXPECT_NEAR(areaOf(cut, 1), 3.1416F * 0.25F, 0.08F) << "the disc is left, and faces as before";
  for (std::size_t i = 0; i < cut.triangles.indices.size(); ++i) {
    if (cut.materialOf[i] != 1) continue;
    for (const std::uint32_t corner : cut.triangles.indices[i]) {
      EXPECT_LT(glm::length(cut.triangles.positions[corner]), 0.62F);
      EXPECT_EQ(cut.normals[corner], Vec3(0, 0, 1));
    }
  }
  EXPECT_FLOAT_EQ(areaOf(cut, 0), 0.5F) << "the stone is whole";
  EXPECT_EQ(cut.normals.size(), cut.triangles.positions.size());
  EXPECT_EQ(cut.uvs.size(), cut.triangles.positions.size());
  EXPECT_EQ(cut.materialOf.size(), cut.triangles.indices.size());
  EXPECT_FALSE(surfaceOf(cut).levels.at(0).triangles.empty());
}

TEST(Holes, OpaqueTexturesAreNotCut) {
  models::Model model = disc(0xFF00FF00U, 0x0000FF00U);
  model.materials[1].alphaCutoff = 0.0F;
  EXPECT_EQ(withHolesCut(model).triangles.indices, model.triangles.indices);
  EXPECT_EQ(warningOf(model), "");
}

TEST(Holes, BlendingBecomesSolidAndIsReported) {
  models::Model model = disc(0x4000FF00U, 0x0500FF00U);  // alpha 0.25 and 0.02
  model.materials[1].blended = true;
  model.materials[1].alphaCutoff = 1.0F;
  EXPECT_NEAR(areaOf(withHolesCut(model), 1), 3.1416F * 0.25F, 0.08F);
  const std::string reported = warningOf(model);
  EXPECT_THAT(reported,
              testing::AllOf(HasSubstr("disc: as a mesh, 'leaf' is solid where it blends"), HasSubstr("light field")));
  EXPECT_EQ(std::ranges::count(reported, '\n'), 1);
}

TEST(Holes, BlendingWithoutTextureIsReported) {
  models::Model model = disc(0xFF00FF00U, 0x0000FF00U);
  model.materials[1] = {.name = "glass", .alphaCutoff = 5.0F, .blended = true};
  EXPECT_THAT(warningOf(model), HasSubstr("disc: as a mesh, 'glass' is solid where it blends; a light field shows it"));
  EXPECT_EQ(withHolesCut(model).triangles.indices, model.triangles.indices);
}

TEST(Holes, TooManyAreKeptAndReported) {
  models::Model model = disc(0xFF00FF00U, 0x0000FF00U);
  const std::size_t leaves = kMaxPieces / 16;
  for (std::size_t i = 0; i < leaves; ++i) {
    model.triangles.indices.push_back({0, 1, 2});
    model.materialOf.push_back(1);
  }
  EXPECT_THAT(warningOf(model), HasSubstr("'leaf' is drawn without its holes"));
  EXPECT_EQ(withHolesCut(model).triangles.indices.size(), model.triangles.indices.size());
}

}  // namespace
}  // namespace grove::objects::mesh
