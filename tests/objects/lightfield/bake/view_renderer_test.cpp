#include "objects/lightfield/bake/view_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "objects/lightfield/bake/models.h"
#include "objects/lightfield/bake/view_plan.h"
#include "objects/lightfield/format/view_sphere.h"
#include "world/camera.h"
#include "world/light.h"

namespace grove::bake {
namespace {

using objects::lightfield::ObjectCamera;
using objects::lightfield::ViewCamera;
using objects::lightfield::ViewGeometry;
using objects::lightfield::ViewSphere;
using world::Vec3;

constexpr int kSize = 32;

/// A camera at the origin that looks along -z; a pixel is 1/16 wide at one metre.
ObjectCamera camera() {
  ObjectCamera camera;
  camera.perColumn = {1.0F / 16.0F, 0, 0};
  camera.perRow = {0, -1.0F / 16.0F, 0};
  camera.corner = {-1, 1, -1};
  return camera;
}

/// Renders a model whose every point gets the light `front` on its front and `back` on its back.
Picture render(const models::Model& model, float front, float back, int samples) {
  const std::vector<TextureSampler> textures(model.textures.begin(), model.textures.end());
  const ModelRays rays(model, textures);
  const LightPoints points = chooseLightPoints(model, textures, 0.1F);
  SurfaceLight light(points.points.size(), 1);
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    const auto values = light.at(i);
    std::fill_n(values.begin(), 3, front);
    std::fill_n(values.begin() + 3, 3, back);
  }
  return ViewRenderer(model, textures, rays, points, light, samples).render(camera(), kSize);
}

std::size_t pixel(int column, int row) {
  return static_cast<std::size_t>(row) * kSize + static_cast<std::size_t>(column);
}

TEST(ViewRenderer, ColourAndDepthOfAWall) {
  models::Model model;
  const std::uint16_t leaf =
      addMaterial(model, {.name = "leaf", .albedo = Vec3(0.5F, 0.25F, 0.1F), .transmittance = Vec3(0.1F, 0.2F, 0.3F)});
  addQuad(model, {-9, -9, -3}, {18, 0, 0}, {0, 18, 0}, leaf);
  const Picture picture = render(model, 1.0F, 2.0F, 2);
  const Vec3 expected(0.7F, 0.65F, 0.7F);
  const std::uint32_t shown = world::toDisplayRgba(expected);
  for (const auto at : {pixel(0, 0), pixel(17, 9), pixel(31, 31)}) {
    EXPECT_NEAR(picture.depth[at], 3.0F, 1.0e-5F);
    for (const unsigned shift : {0U, 8U, 16U, 24U}) {
      EXPECT_NEAR(static_cast<int>(picture.colour[0][at] >> shift & 0xFFU), static_cast<int>(shown >> shift & 0xFFU),
                  1);
    }
  }
}

TEST(ViewRenderer, BackFacesUseTheirOwnLight) {
  models::Model model;
  addQuad(model, {-9, -9, -3}, {0, 18, 0}, {18, 0, 0}, addMaterial(model, {.name = "leaf", .albedo = Vec3(1.0F)}));
  const std::uint32_t seen = render(model, 0.1F, 0.5F, 1).colour[0][pixel(5, 5)];
  EXPECT_NEAR(static_cast<int>(seen & 0xFFU), static_cast<int>(world::toDisplayRgba(Vec3(0.5F)) & 0xFFU), 1);
}

TEST(ViewRenderer, SingleSidedIsCulled) {
  for (const bool pierced : {false, true}) {
    models::Model model;
    model.textures.push_back({1, 1, {0xFFFFFFFFU}});
    models::Material material{.name = "plate", .albedo = Vec3(1.0F), .twoSided = false};
    if (pierced) {
      material.texture = 0;
      material.alphaCutoff = 0.5F;
    }
    const std::uint16_t plate = addMaterial(model, material);
    addQuad(model, {-9, -9, -3}, {0, 18, 0}, {9, 0, 0}, plate);  // on the left, its back to the camera
    addQuad(model, {0, -9, -3}, {9, 0, 0}, {0, 18, 0}, plate);   // on the right, its front
    const Picture picture = render(model, 0.5F, 0.5F, 1);
    EXPECT_EQ(picture.colour[0][pixel(5, 5)], 0U) << pierced;
    EXPECT_EQ(picture.depth[pixel(5, 5)], world::kInfiniteDepth) << pierced;
    EXPECT_NE(picture.colour[0][pixel(25, 5)], 0U) << pierced;
  }
}

TEST(ViewRenderer, CoverageIsTheShareOfSamplesAndColourIsPremultiplied) {
  models::Model model;
  // Its edge goes through the middle of column 16's pixels at one metre.
  addQuad(model, {-2, -2, -1}, {2.03125F, 0, 0}, {0, 4, 0}, addMaterial(model, whiteStone()));
  const Picture picture = render(model, 0.5F, 0.0F, 4);
  const std::uint32_t whole = picture.colour[0][pixel(15, 10)];
  const std::uint32_t half = picture.colour[0][pixel(16, 10)];
  EXPECT_EQ(whole >> 24U, 255U);
  EXPECT_NEAR(static_cast<int>(half >> 24U), 128, 1);
  EXPECT_NEAR(static_cast<int>(half & 0xFFU), static_cast<int>(whole & 0xFFU) / 2, 1);
  EXPECT_NEAR(picture.depth[pixel(16, 10)], 1.0F, 1.0e-5F) << "a pixel that is covered in part has the surface's depth";
  EXPECT_EQ(picture.colour[0][pixel(17, 10)], 0U);
  EXPECT_EQ(picture.depth[pixel(17, 10)], world::kInfiniteDepth);
}

TEST(ViewRenderer, EdgeDepthIsOfOneSurface) {
  models::Model model;
  const std::uint16_t white = addMaterial(model, whiteStone());
  addQuad(model, {-2, -2, -1}, {2.0F + 0.75F / 16.0F, 0, 0}, {0, 4, 0}, white);  // three quarters of column 16
  addQuad(model, {-20, -20, -4}, {40, 0, 0}, {0, 40, 0}, white);
  const Picture picture = render(model, 0.5F, 0.0F, 4);
  EXPECT_NEAR(picture.depth[pixel(16, 10)], 1.0F, 1.0e-5F);
  for (const float depth : picture.depth) EXPECT_LT(std::min(std::abs(depth - 1.0F), std::abs(depth - 4.0F)), 1.0e-4F);
}

TEST(ViewRenderer, TexturesColourAndPierce) {
  models::Model model;
  model.textures.push_back({2, 1, {0xFF0000FFU, 0x0000FF00U}});  // red, and a hole
  const std::uint16_t mask =
      addMaterial(model, {.name = "mask", .albedo = Vec3(1.0F), .texture = 0, .alphaCutoff = 0.5F});
  addQuad(model, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, mask);
  const Picture picture = render(model, 0.5F, 0.5F, 2);
  const std::uint32_t red = picture.colour[0][pixel(8, 8)];
  EXPECT_GT(red & 0xFFU, 100U);
  EXPECT_LT(red >> 8U & 0xFFU, 30U);
  EXPECT_EQ(picture.colour[0][pixel(24, 8)], 0U);
}

TEST(ViewPlan, CamerasAreOutsideTheBoundingBall) {
  const models::Model model = crookedTree();
  const ViewGeometry geometry = planViews(model.triangles);
  float largest = 0.0F;
  for (const Vec3 p : model.triangles.positions) {
    EXPECT_LE(glm::distance(p, geometry.target), geometry.extent);
    largest = std::max(largest, glm::distance(p, geometry.target));
  }
  EXPECT_GT(largest, 0.95F * geometry.extent) << "the ball is tight";
  EXPECT_EQ(geometry.centre.y, 0.0F);
  const ViewSphere sphere(3);
  for (int view = 0; view < sphere.views(); ++view) {
    const ViewCamera camera = viewCamera(geometry, sphere.direction(view));
    EXPECT_GT(camera.nearDepth, 0.0F);
    for (const Vec3 p : model.triangles.positions) {
      const float depth = glm::dot(p - camera.eye, camera.forward);
      EXPECT_LT(std::abs(glm::dot(p - camera.eye, camera.right) / depth * camera.focal), 0.5F);
      EXPECT_LT(std::abs(glm::dot(p - camera.eye, camera.down) / depth * camera.focal), 0.5F);
    }
  }
}

TEST(ViewPlan, HeldOutCamerasAreNotViews) {
  const ViewGeometry geometry = planViews(crookedTree().triangles);
  for (const int n : {1, 2, 7, 64, 128}) {
    const ViewSphere sphere(n);
    const auto cameras = planHeldOut(geometry, n, kSize);
    EXPECT_EQ(cameras.size(), 24U);
    float lowest = 1.0F;
    for (const ObjectCamera& camera : cameras) {
      const Vec3 direction = glm::normalize(camera.eye - geometry.centre);
      EXPECT_GE(direction.y, 0.0F);
      lowest = std::min(lowest, direction.y);
      const ViewSphere::Nearest nearest = sphere.nearest(direction);
      for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(nearest.weight[i], 0.97F) << "n " << n;
    }
    EXPECT_LT(lowest, n == 1 ? 0.6F : 0.3F) << "some are low, n " << n;
  }
}

}  // namespace
}  // namespace grove::bake
