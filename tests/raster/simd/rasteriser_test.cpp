#include "raster/simd/rasteriser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "raster/simd/near_clip.h"
#include "raster/simd/triangle_kernels.h"

namespace grove::raster {
namespace {

using world::Vec3;

constexpr int kSize = 200;
constexpr world::Rect kAll{0, 0, kSize, kSize};

Corner cornerAt(float x, float y, float reversed = 0.5F) { return {x, y, {reversed, 0, 0, 0, 0, 0}}; }

std::size_t covered(const Canvas& canvas) {
  return static_cast<std::size_t>(std::ranges::count_if(canvas.depth, [](float depth) { return depth > 0.0F; }));
}

void drawTriangle(const Corner& a, const Corner& b, const Corner& c, Canvas& canvas) {
  drawTriangles(std::vector<Triangle>{{0, 1, 2}}, std::vector<Corner>{a, b, c}, canvas);
}

TEST(Rasteriser, ConvexBodiesHaveNoHoles) {
  const Surface ball = makeDeformedBox({5, 5, 5}, 1, [](Vec3 cube) {
    Vertex vertex;
    vertex.position = glm::normalize(cube);
    return vertex;
  });
  LitSurface lit{ball, std::vector<world::Vec4>(ball.vertices.size(), world::Vec4(1.0F)), true};
  const VertexArrays arrays(lit);
  for (int turn = 0; turn < 60; ++turn) {
    world::Camera camera;
    camera.width = kSize;
    camera.height = kSize;
    camera.pose.yaw = 0.37F * static_cast<float>(turn);
    camera.pose.pitch = 1.3F * std::sin(0.71F * static_cast<float>(turn));
    camera.pose.position = -3.0F * camera.pose.forward();
    Drawing drawing;
    drawing.object = &lit;
    drawing.camera = &camera;
    drawing.rect = kAll;
    drawing.bones.fill(world::Mat4(1.0F));
    ScreenVertices vertices;
    vertices.light.resize(ball.vertices.size());
    project(arrays, drawing, vertices);
    Canvas canvas;
    canvas.begin(kAll);
    drawTriangles(ball.levels.back().triangles, vertices.corners, canvas);
    // The ball's outline is a circle; its triangles stay a little within.
    const float radius = camera.focal() / std::sqrt(8.0F);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const float out = std::hypot(static_cast<float>(x) + 0.5F - 100.0F, static_cast<float>(y) + 0.5F - 100.0F);
        const float depth = canvas.depth[static_cast<std::size_t>(y * canvas.stride + x)];
        if (out < 0.97F * radius) {
          // The near side, not the far one through a hole.
          ASSERT_GT(depth, camera.nearDepth / 2.95F) << x << ", " << y << " turn " << turn;
          ASSERT_LT(depth, camera.nearDepth / 1.95F) << x << ", " << y << " turn " << turn;
        }
        if (out > 1.01F * radius) {
          ASSERT_EQ(depth, 0.0F) << x << ", " << y << " turn " << turn;
        }
      }
    }
  }
}

TEST(Rasteriser, CullsBackFacesAndTestsDepth) {
  Canvas canvas;
  canvas.begin(kAll);
  const auto far = [](float x, float y) { return cornerAt(x, y, 0.25F); };
  drawTriangle(cornerAt(10, 10), cornerAt(90, 10), cornerAt(10, 90), canvas);
  EXPECT_EQ(covered(canvas), 0U);
  drawTriangle(cornerAt(10, 10), cornerAt(10, 90), cornerAt(90, 10), canvas);
  drawTriangle(far(10, 10), far(10, 190), far(190, 10), canvas);
  EXPECT_EQ(canvas.depth[static_cast<std::size_t>(20 * canvas.stride + 20)], 0.5F);
  EXPECT_EQ(canvas.depth[static_cast<std::size_t>(20 * canvas.stride + 150)], 0.25F);
}

TEST(Rasteriser, SpansBoundTheDrawingAndAreReset) {
  Canvas canvas;
  canvas.begin(kAll);
  drawTriangle(cornerAt(30, 10), cornerAt(30, 90), cornerAt(110, 10), canvas);
  drawTriangle(cornerAt(150, 50), cornerAt(150, 60), cornerAt(160, 50), canvas);
  for (int y = 0; y < kSize; ++y) {
    int first = kSize;
    int end = 0;
    for (int x = 0; x < canvas.stride; ++x) {
      if (canvas.depth[static_cast<std::size_t>(y * canvas.stride + x)] == 0.0F) continue;
      first = std::min(first, x);
      end = x + 1;
    }
    ASSERT_EQ(canvas.spans[static_cast<std::size_t>(y)].begin, first) << y;
    ASSERT_EQ(canvas.spans[static_cast<std::size_t>(y)].end, end) << y;
  }
  canvas.begin({40, 20, 97, 160});
  EXPECT_EQ(canvas.spans.size(), 140U);
  EXPECT_EQ(covered(canvas), 0U);
}

TEST(Rasteriser, InterpolationIsPerspectiveCorrect) {
  Canvas canvas;
  canvas.begin(kAll);
  // A floor that recedes from depth 1 to 4: half way on the screen is a fifth of the way in space.
  const auto corner = [](float x, float y, float depth, float red) {
    return projected({x * depth, y * depth, depth, {red, 0, 0, 0, 0}}, 1.0F);
  };
  drawTriangle(corner(0, 200, 1, 0), corner(200, 200, 1, 0), corner(0, 0, 4, 250), canvas);
  const std::uint32_t middle = canvas.surface[static_cast<std::size_t>(100 * canvas.stride + 10)] & 0xFFU;
  EXPECT_NEAR(static_cast<double>(middle), 50.0, 2.0);
}

TEST(NearClip, KeepsTheFarSide) {
  const auto vertex = [](float depth) { return ClipVertex{depth, 0, depth, {depth, 0, 0, 0, 0}}; };
  EXPECT_EQ(NearClip({vertex(1), vertex(2), vertex(3)}, 0.5F).polygon().size(), 3U);
  EXPECT_EQ(NearClip({vertex(-1), vertex(2), vertex(3)}, 0.5F).polygon().size(), 4U);
  EXPECT_EQ(NearClip({vertex(-1), vertex(-2), vertex(3)}, 0.5F).polygon().size(), 3U);
  EXPECT_TRUE(NearClip({vertex(-1), vertex(-2), vertex(0.4F)}, 0.5F).polygon().empty());
  const NearClip clipped({vertex(-1), vertex(2), vertex(3)}, 0.5F);
  for (const ClipVertex& corner : clipped.polygon()) {
    EXPECT_GE(corner.depth, 0.5F);
    EXPECT_NEAR(corner.shade[0], corner.depth, 1.0e-5F);
  }
}

}  // namespace
}  // namespace grove::raster
