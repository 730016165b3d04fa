#include "raster/outline/outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "raster/box.h"
#include "raster/simd/simd_mesh_renderer.h"

namespace grove::raster {
namespace {

using world::Vec3;

constexpr int kFrame = 96;
/// Pixels of the finer picture along a pixel's side.
constexpr int kFiner = 16;

/// A surface that shines by itself, as a body between two poles of other colours.
LitSurface lit(Surface surface) {
  for (Vertex& vertex : surface.vertices) vertex.emission = 1.0F;
  const std::size_t count = surface.vertices.size();
  return {std::move(surface), std::vector<world::Vec4>(count, world::Vec4(0.0F)), true};
}

LitSurface ball() {
  return lit(makeDeformedBox({6, 6, 6}, 0, [](Vec3 cube) {
    Vertex vertex;
    vertex.position = glm::normalize(cube);
    vertex.albedo = Vec3(0.5F) + 0.4F * vertex.position;
    return vertex;
  }));
}

class OutlineTest : public testing::Test {
 protected:
  [[nodiscard]] std::shared_ptr<Image> draw(const LitSurface& object, world::Camera camera, int finer = 1) {
    camera.width *= finer;
    camera.height *= finer;
    Drawing drawing;
    drawing.object = &object;
    drawing.camera = &camera;
    drawing.sky = &sky_;
    drawing.rect = {0, 0, camera.width, camera.height};
    drawing.bones.fill(world::Mat4(1.0F));
    std::array<std::shared_ptr<Image>, 1> images;
    SimdMeshRenderer renderer(images_, {memory_, "mesh"});
    renderer.render({&drawing, 1}, images);
    const Image& image = *images.front();
    for (int y = 0; y < image.height(); ++y) {  // what the spans leave out
      for (int x = 0; x < image.width(); ++x) {
        if (x >= image.span(y).begin && x < image.span(y).end) continue;
        images.front()->colourRow(y)[x] = 0;
        images.front()->depthRow(y)[x] = world::kInfiniteDepth;
      }
    }
    return images.front();
  }

  /// Shares of pixels whose centres the finer picture shows; its own outline counts by half or not.
  [[nodiscard]] static float coverage(const Image& finer, int x, int y) {
    int covered = 0;
    for (int i = 0; i < kFiner * kFiner; ++i) {
      covered += finer.colourRow(y * kFiner + i / kFiner)[x * kFiner + i % kFiner] >> 31U;
    }
    return 255.0F * static_cast<float>(covered) / (kFiner * kFiner);
  }

  void expectCoverageOf(const LitSurface& object, const world::Camera& camera) {
    const auto image = draw(object, camera);
    const auto finer = draw(object, camera, kFiner);
    int partly = 0;
    double sum = 0.0;
    for (int y = 0; y < kFrame; ++y) {
      for (int x = 0; x < kFrame; ++x) {
        const auto share = static_cast<float>(image->colourRow(y)[x] >> 24U);
        const float expected = coverage(*finer, x, y);
        ASSERT_NEAR(share, expected, 26.0F) << x << ", " << y;
        if (expected == 0.0F || expected == 255.0F) continue;
        ++partly;
        sum += std::abs(share - expected);
      }
    }
    ASSERT_GT(partly, 60);
    EXPECT_LT(sum / partly, 4.0);
  }

  [[nodiscard]] static world::Camera cameraAt(Vec3 position, float yaw = 0.0F, float pitch = 0.0F) {
    world::Camera camera;
    camera.width = kFrame;
    camera.height = kFrame;
    camera.pose = {position, yaw, pitch};
    return camera;
  }

 private:
  pipeline::MemoryLedger memory_;
  ImagePool images_;
  const world::Sky sky_{};
};

/// Fails if the outline is stair-stepped, or smoothed by anything but the shares of the pixels.
TEST_F(OutlineTest, PixelsAreCoveredAsManySamplesSay) {
  const LitSurface round = ball();
  expectCoverageOf(round, cameraAt({0.2F, 0.1F, 3.1F}));
  expectCoverageOf(round, cameraAt({1.3F, 0.1F, 2.4F}));  // cut by the frame's left side
  const LitSurface box = lit(makeBox({1.1F, 1.2F, 0.9F}, {0.6F, 0.4F, 0.3F}));
  for (const float yaw : {0.0F, 0.05F, 0.6F}) {
    const Vec3 back(std::sin(yaw), 0.0F, std::cos(yaw));
    expectCoverageOf(box, cameraAt(Vec3(0, 1.0F, 0) + 2.4F * back, yaw, -0.15F));
  }
}

/// Fails if clipped triangles, which share no corners, show their own edges, or if the outline ends with them.
TEST_F(OutlineTest, HoldsWhereTrianglesAreClipped) {
  const LitSurface floor = lit(makeBox({2.0F, 0.2F, 12.0F}, {0.6F, 0.4F, 0.3F}));
  expectCoverageOf(floor, cameraAt({0.3F, 1.7F, 3.0F}, 0.1F, -0.2F));
}

/// Fails if a pixel whose centre is outside has no colour, a wrong one, or no depth.
TEST_F(OutlineTest, PixelsWithoutFragmentsLookLikeTheirNeighbours) {
  const Vec3 albedo(0.6F, 0.4F, 0.3F);
  const LitSurface box = lit(makeBox({1.1F, 1.2F, 0.9F}, albedo));
  const auto image = draw(box, cameraAt({0.2F, 1.4F, 2.4F}, 0.3F, -0.15F));
  const std::uint32_t whole = image->colourRow(kFrame / 2)[kFrame / 2];
  ASSERT_EQ(whole >> 24U, 255U);
  int few = 0;
  for (std::size_t i = 0; i < image->colour.size(); ++i) {
    const std::uint32_t share = image->colour[i] >> 24U;
    EXPECT_EQ(share > 0, image->depth[i] < world::kInfiniteDepth);
    for (const unsigned shift : {0U, 8U, 16U}) {
      const double full = static_cast<double>(whole >> shift & 0xFFU);
      EXPECT_NEAR(image->colour[i] >> shift & 0xFFU, full * share / 255.0, 1.6) << i;
    }
    if (share > 0 && share < 128) ++few;
  }
  EXPECT_GT(few, 20);
}

}  // namespace
}  // namespace grove::raster
