#include "node/frontend/backdrops/backdrop_warp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "each_target.h"
#include "node/frontend/backdrops/drawn_backdrop.h"

namespace grove::node {
namespace {

using testing::backdropOf;
using testing::cameraOf;
using testing::Painter;
using testing::Pixel;

constexpr std::uint32_t kPoison = 0x00010203U;
constexpr float kPoisonDepth = -7.0F;

/// A smooth pattern, so that interpolation is exact to about a step.
std::uint32_t patternAt(float u, float v) {
  const auto wave = [](float phase) { return static_cast<std::uint32_t>(127.5F + 100.0F * std::sin(phase)); };
  return 0xFF000000U | wave(u) << 16U | wave(v) << 8U | wave(u + v);
}

/// Infinitely far.
Pixel skyAt(const world::Camera&, world::Vec3 ray) {
  const world::Vec3 direction = glm::normalize(ray);
  return {patternAt(9.0F * direction.x, 9.0F * direction.y), world::kInfiniteDepth};
}

/// A wall at z = -5.
Pixel wallAt(const world::Camera& camera, world::Vec3 ray) {
  const float depth = (-5.0F - camera.pose.position.z) / ray.z;
  const world::Vec3 point = camera.pose.position + depth * ray;
  return {patternAt(2.0F * point.x, 2.0F * point.y), depth};
}

class BackdropWarpTest : public ::testing::Test {
 protected:
  /// In bands, as the Compositor does.
  std::shared_ptr<raster::Image> show(const Backdrop& backdrop, const world::Camera& camera,
                                      std::vector<world::Rect> withDepth = {}) {
    auto frame = pool.acquire({0, 0, camera.width, camera.height});
    std::ranges::fill(frame->colour, kPoison);
    std::ranges::fill(frame->depth, kPoisonDepth);
    const BackdropWarp warp(backdrop, camera, std::move(withDepth));
    for (int top = 0; top < camera.height; top += 48) {
      const auto edges = pool.acquire({0, top, camera.width, std::min(top + 48, camera.height)});
      FrameBuilder rows(*frame, *edges);
      warp.fill(rows);
      rows.finish();
    }
    return frame;
  }

  static void expectLike(const raster::Image& shown, const raster::Image& wanted, int tolerance) {
    for (int y = 0; y < shown.height(); ++y) {
      for (int x = 0; x < shown.width(); ++x) {
        for (const unsigned shift : {0U, 8U, 16U, 24U}) {
          const auto channel = [&](const raster::Image& image) {
            return static_cast<int>(image.colourRow(y)[x] >> shift & 0xFFU);
          };
          ASSERT_LE(std::abs(channel(shown) - channel(wanted)), tolerance) << x << ", " << y << ", " << shift;
        }
      }
    }
  }

  raster::ImagePool pool;
};

TEST_F(BackdropWarpTest, CopiesForTheSameCamera) {
  const world::Camera camera = cameraOf(431, 243);
  const auto backdrop = backdropOf(wallAt, camera, {-10, -4, 440, 250});
  const auto frame = show(*backdrop, camera, {{100, 20, 140, 60}});
  expectLike(*frame, *testing::paint(wallAt, camera, frame->rect), 0);
  EXPECT_FLOAT_EQ(frame->depthRow(30)[120], 5.0F);
}

TEST_F(BackdropWarpTest, ShowsWhatATurnedCameraSees) {
  const world::Camera before = cameraOf(640, 360);
  const auto backdrop = backdropOf(skyAt, before, {-60, -40, 700, 400});
  world::Camera after = before;
  after.pose.yaw += 0.06F;
  after.pose.pitch -= 0.03F;
  tests::onEachTarget([&] {
    const auto frame = show(*backdrop, after, {{0, 0, 640, 360}});
    expectLike(*frame, *testing::paint(skyAt, after, frame->rect), 3);
    EXPECT_EQ(frame->depthRow(100)[100], world::kInfiniteDepth);
  });
}

TEST_F(BackdropWarpTest, ShowsWhatAMovedCameraSees) {
  const world::Camera before = cameraOf(640, 360);
  const auto backdrop = backdropOf(wallAt, before, {-40, -40, 680, 400});
  world::Camera after = before;
  after.pose.position += world::Vec3(0.08F, -0.05F, -0.2F);
  after.pose.yaw += 0.02F;
  tests::onEachTarget([&] {
    const auto frame = show(*backdrop, after, {{0, 0, 640, 360}});
    const auto wanted = testing::paint(wallAt, after, frame->rect);
    expectLike(*frame, *wanted, 4);
    for (std::size_t i = 0; i < wanted->depth.size(); ++i) ASSERT_NEAR(frame->depth[i], wanted->depth[i], 0.02F) << i;
  });
}

/// Fails under the address sanitizer if a look-up of the last square reads what lies behind it.
TEST_F(BackdropWarpTest, ShowsTheLastPixelsOfItsImage) {
  const world::Camera before = cameraOf(640, 360);
  const auto backdrop = backdropOf(skyAt, before, {0, 0, 640, 360});
  world::Camera after = before;
  after.pose.yaw -= 0.01F;
  after.pose.pitch -= 0.01F;
  tests::onEachTarget([&] {
    const auto frame = show(*backdrop, after, {{0, 0, 640, 360}});
    EXPECT_EQ(frame->depthRow(359)[639], world::kInfiniteDepth);
  });
}

/// Fails if a row of cells writes beyond its end, into the next row or the next strip.
TEST_F(BackdropWarpTest, FillsFramesOfAnySize) {
  for (const int width : {8, 250, 263, 431, 530}) {
    const world::Camera before = cameraOf(width, 131);
    const auto backdrop = backdropOf(wallAt, before, {-20, -20, width + width % 2 + 20, 152});
    world::Camera after = before;
    after.pose.position.x += 0.05F;
    tests::onEachTarget([&] {
      const auto frame = show(*backdrop, after);
      expectLike(*frame, *testing::paint(wallAt, after, frame->rect), 4);
    });
  }
}

TEST_F(BackdropWarpTest, WritesDepthsOnlyWhereTheyAreNeeded) {
  const world::Camera before = cameraOf(640, 360);
  const auto backdrop = backdropOf(wallAt, before, {-20, -20, 660, 380});
  world::Camera after = before;
  after.pose.position.x += 0.05F;
  const auto frame = show(*backdrop, after, {{10, 100, 50, 110}});
  EXPECT_NEAR(frame->depthRow(105)[30], 5.0F, 0.02F);
  EXPECT_EQ(frame->depthRow(300)[30], kPoisonDepth);
}

/// Fails if the corner cells of an outline are stretched between what is in front and what is behind.
TEST_F(BackdropWarpTest, KeepsTheOutlineOfAPostStraight) {
  const Painter post = [](const world::Camera& camera, world::Vec3 ray) {
    const world::Vec3 point = camera.pose.position + 2.0F * ray;
    return std::abs(point.x) < 0.3F ? Pixel{0xFFFFFFFFU, 2.0F} : Pixel{0xFF000000U, 40.0F};
  };
  const world::Camera before = cameraOf(640, 360);
  const auto backdrop = backdropOf(post, before, {-20, -20, 660, 380});
  world::Camera after = before;
  after.pose.position.x += 0.04F;
  tests::onEachTarget([&] {
    const auto frame = show(*backdrop, after);
    for (int y = 0; y < frame->height(); ++y) {
      const auto* const row = frame->colourRow(y);
      const auto first = std::find_if(row, row + 640, [](std::uint32_t colour) { return (colour & 0xFFU) > 127U; });
      const float left = 320.0F + after.focal() * (-0.3F - 0.04F) / 2.0F;
      ASSERT_NEAR(static_cast<float>(first - row), left, 1.0F) << y;
      const auto end = std::find_if(first, row + 640, [](std::uint32_t colour) { return (colour & 0xFFU) <= 127U; });
      ASSERT_NEAR(static_cast<float>(end - first), after.focal() * 0.3F, 1.0F) << y;
    }
  });
}

}  // namespace
}  // namespace grove::node
