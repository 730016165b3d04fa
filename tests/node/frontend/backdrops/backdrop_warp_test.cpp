#include "node/frontend/backdrops/backdrop_warp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "each_target.h"
#include "node/frontend/backdrops/drawn_backdrop.h"
#include "yuv_pictures.h"

namespace grove::node {
namespace {

using testing::backdropOf;
using testing::cameraOf;
using testing::Painter;
using testing::Pixel;

constexpr std::uint8_t kPoison = 7;
constexpr std::uint32_t kPoisonColour = 0x00010203U;
constexpr float kPoisonDepth = -7.0F;
constexpr float kPoisonNearness = -7.0F;

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

/// A slope that rises towards a horizon out of sight.
Pixel floorAt(const world::Camera& camera, world::Vec3 ray) {
  const float depth = (-12.0F - camera.pose.position.z) / (ray.z + 0.8F * ray.y);
  const world::Vec3 point = camera.pose.position + depth * ray;
  return {patternAt(2.0F * point.x, 2.0F * point.y), depth};
}

struct Shown {
  std::shared_ptr<const raster::YuvImage> picture;
  std::shared_ptr<const raster::Image> layers;
  std::shared_ptr<const CellNearness> nearness;
};

class BackdropWarpTest : public ::testing::Test {
 protected:
  /// In bands, as the Compositor does.
  Shown show(const Backdrop& backdrop, const world::Camera& camera, const std::vector<world::Rect>& drawn = {}) {
    const world::Rect whole{0, 0, camera.width, camera.height};
    const auto picture = raster::acquireYuv(pool, whole);
    const auto layers = pool.acquire(whole);
    std::ranges::fill(picture->bytes, kPoison);
    std::ranges::fill(layers->colour, kPoisonColour);
    std::ranges::fill(layers->depth, kPoisonDepth);
    const BackdropWarp warp(backdrop, camera);
    const FreshParts fresh(whole, drawn);
    const auto nearness = std::make_shared<CellNearness>(camera.width, camera.height, pool);
    std::ranges::fill(nearness->cells(), kPoisonNearness);
    for (int top = 0; top < camera.height; top += 48) {
      warp.fill(top, std::min(top + 48, camera.height), fresh, {*picture, *layers, *nearness});
    }
    return {picture, layers, nearness};
  }

  /// Both halves of a frame's bytes, luma and chroma.
  static void expectLike(const raster::YuvImage& shown, const raster::Image& wanted, int tolerance) {
    const auto yuv = tests::yuvOf(wanted);
    for (std::size_t i = 0; i < yuv->bytes.size(); ++i) {
      ASSERT_LE(std::abs(shown.bytes[i] - yuv->bytes[i]), tolerance)
          << i << " of " << shown.width() << " x " << shown.height();
    }
  }

  raster::ImagePool pool;
};

TEST_F(BackdropWarpTest, SameCameraCopies) {
  const world::Camera camera = cameraOf(432, 242);
  const auto backdrop = backdropOf(wallAt, camera, {-10, -4, 440, 250});
  tests::onEachTarget([&] {
    const Shown shown = show(*backdrop, camera, {{100, 20, 140, 60}});
    expectLike(*shown.picture, *testing::paint(wallAt, camera, shown.picture->rect), 0);
    EXPECT_NEAR(shown.layers->depthRow(30)[120], 5.0F, 0.01F);
  });
}

/// Fails if pixels share a depth: smoke behind a stone would show steps along its outline.
TEST_F(BackdropWarpTest, EachPixelHasItsOwnDepth) {
  const world::Camera camera = cameraOf(432, 240);
  const world::Rect area{-8, -8, 440, 248};
  const auto image = testing::paint(wallAt, camera, area);
  const auto depthAt = [](int x, int y) { return (x + y) % 2 == 0 ? 4.0F : 9.0F; };
  for (int y = 0; y < area.height(); ++y) {
    for (int x = 0; x < area.width(); ++x) image->depthRow(y)[x] = depthAt(area.left + x, area.top + y);
  }
  const auto backdrop = backdropOf(image, {std::make_shared<const View>(testing::viewOf(camera)), 1, true});
  tests::onEachTarget([&] {
    const Shown shown = show(*backdrop, camera, {{0, 0, 432, 240}});
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        ASSERT_NEAR(shown.layers->depthRow(y)[x], depthAt(x, y), 0.01F) << x << ", " << y;
      }
    }
  });
}

TEST_F(BackdropWarpTest, TurnedCamera) {
  const world::Camera before = cameraOf(640, 360);
  const auto backdrop = backdropOf(skyAt, before, {-60, -40, 700, 400});
  world::Camera after = before;
  after.pose.yaw += 0.06F;
  after.pose.pitch -= 0.03F;
  tests::onEachTarget([&] {
    const Shown shown = show(*backdrop, after, {{0, 0, 640, 360}});
    expectLike(*shown.picture, *testing::paint(skyAt, after, shown.picture->rect), 3);
    EXPECT_EQ(shown.layers->depthRow(100)[100], world::kInfiniteDepth);
  });
}

TEST_F(BackdropWarpTest, MovedCamera) {
  const world::Camera before = cameraOf(640, 360);
  const auto backdrop = backdropOf(wallAt, before, {-40, -40, 680, 400});
  world::Camera after = before;
  after.pose.position += world::Vec3(0.08F, -0.05F, -0.2F);
  after.pose.yaw += 0.02F;
  tests::onEachTarget([&] {
    const Shown shown = show(*backdrop, after, {{0, 0, 640, 360}});
    const auto wanted = testing::paint(wallAt, after, shown.picture->rect);
    expectLike(*shown.picture, *wanted, 4);
    const auto& depths = shown.layers->depth;
    for (std::size_t i = 0; i < wanted->depth.size(); ++i) ASSERT_NEAR(depths[i], wanted->depth[i], 0.02F) << i;
  });
}

/// Fails under the address sanitizer if a look-up of the last pixel reads what lies behind it.
TEST_F(BackdropWarpTest, ShowsItsLastPixels) {
  const world::Camera before = cameraOf(640, 360);
  const auto backdrop = backdropOf(skyAt, before, {0, 0, 640, 360});
  world::Camera after = before;
  after.pose.yaw -= 0.01F;
  after.pose.pitch -= 0.01F;
  tests::onEachTarget([&] {
    const Shown shown = show(*backdrop, after, {{0, 0, 640, 360}});
    EXPECT_EQ(shown.layers->depthRow(359)[639], world::kInfiniteDepth);
  });
}

/// Fails if a row of cells writes beyond its end, into the next row or the next strip.
TEST_F(BackdropWarpTest, FillsAnyEvenSize) {
  for (const int width : {34, 250, 264, 432, 530}) {
    const world::Camera before = cameraOf(width, 130);
    const auto backdrop = backdropOf(wallAt, before, {-20, -20, width + 20, 152});
    world::Camera after = before;
    after.pose.position.x += 0.05F;
    tests::onEachTarget([&] {
      const Shown shown = show(*backdrop, after);
      expectLike(*shown.picture, *testing::paint(wallAt, after, shown.picture->rect), 4);
    });
  }
}

/// A backdrop may lack a strip at the frame's edges: its outermost samples are repeated there.
TEST_F(BackdropWarpTest, RepeatsEdgesOutside) {
  const Painter framed = [](const world::Camera& camera, world::Vec3 ray) {
    const bool outermost = std::abs(ray.x) > 0.98F * camera.tanHalfX();
    return Pixel{outermost ? 0xFFC8C8C8U : 0xFF3C3C3CU, 20.0F};
  };
  const world::Camera before = cameraOf(640, 360);
  const auto backdrop = backdropOf(framed, before, {0, 0, 640, 360});
  for (const float turn : {-0.15F, 0.15F}) {
    world::Camera after = before;
    after.pose.yaw += turn;
    after.pose.pitch += turn;
    tests::onEachTarget([&] {
      const Shown shown = show(*backdrop, after);
      const raster::YuvImage& picture = *shown.picture;
      for (const int y : {0, 179, 359}) {
        EXPECT_EQ(picture.y()[std::ptrdiff_t{y} * 640], turn > 0.0F ? 0xC8 : 0x3C) << y;
        EXPECT_EQ(picture.y()[std::ptrdiff_t{y} * 640 + 639], turn > 0.0F ? 0x3C : 0xC8) << y;
        EXPECT_EQ(picture.u()[std::ptrdiff_t{y / 2} * 320], 128) << y;
      }
    });
  }
}

/// Cells that are stretched too much for the kernels' blocks are warped sample by sample; fails if the two differ.
TEST_F(BackdropWarpTest, StrongScaling) {
  const world::Camera before = cameraOf(640, 360);
  const auto backdrop = backdropOf(wallAt, before, {0, 0, 640, 360});
  world::Camera after = before;
  after.pose.position.z = 10.0F;  // a third of the size
  tests::onEachTarget([&] {
    const Shown shown = show(*backdrop, after);
    const auto wanted = tests::yuvOf(*testing::paint(wallAt, after, shown.picture->rect));
    for (int y = 130; y < 230; ++y) {
      for (int x = 230; x < 410; ++x) {
        ASSERT_NEAR(shown.picture->y()[shown.picture->lumaAt(x, y)], wanted->y()[wanted->lumaAt(x, y)], 3)
            << x << ", " << y;
      }
    }
  });
}

/// Fails if a backdrop is shown at a wrong place while pictures have another size than it.
TEST_F(BackdropWarpTest, ShowsPicturesOfAnotherSize) {
  const world::Camera before = cameraOf(640, 360);
  const auto backdrop = backdropOf(wallAt, before, {0, 0, 640, 360});
  for (const auto& [width, height] : {std::pair(480, 270), std::pair(768, 432), std::pair(320, 180)}) {
    const world::Camera after = cameraOf(width, height);
    tests::onEachTarget([&, width = width, height = height] {
      const Shown shown = show(*backdrop, after);
      const auto wanted = tests::yuvOf(*testing::paint(wallAt, after, shown.picture->rect));
      for (int y = 8; y < height - 8; ++y) {
        for (int x = 8; x < width - 8; ++x) {
          ASSERT_NEAR(shown.picture->y()[shown.picture->lumaAt(x, y)], wanted->y()[wanted->lumaAt(x, y)], 3)
              << x << ", " << y << " of " << height;
        }
      }
    });
  }
}

TEST_F(BackdropWarpTest, PreparesOnlyOverdrawnParts) {
  const world::Camera before = cameraOf(640, 360);
  const auto backdrop = backdropOf(wallAt, before, {-20, -20, 660, 380});
  world::Camera after = before;
  after.pose.position.x += 0.05F;
  const Shown shown = show(*backdrop, after, {{10, 100, 50, 110}});
  EXPECT_NEAR(shown.layers->depthRow(105)[30], 5.0F, 0.02F);
  const auto below = tests::rgbaOf(*shown.picture);
  EXPECT_EQ(shown.layers->colourRow(105)[30], below->colourRow(105)[30]);
  EXPECT_EQ(shown.layers->depthRow(300)[30], kPoisonDepth);
  EXPECT_EQ(shown.layers->colourRow(300)[30], kPoisonColour);
}

/// Of the cells that are wholly within `part`.
void expectNearness(const CellNearness& shown, const raster::Image& wanted, const world::Rect& part) {
  constexpr int kCell = CellNearness::kCell;
  for (int top = part.top; top + kCell <= part.bottom; top += kCell) {
    for (int left = part.left; left + kCell <= part.right; left += kCell) {
      const float depth = wanted.depthRow(top + kCell / 2)[left + kCell / 2];
      ASSERT_NEAR(shown.row(top / kCell)[static_cast<std::size_t>(left / kCell)] * depth, 1.0F, 0.03F)
          << left << ", " << top;
    }
  }
}

// Faults: nearness as the backdrop's camera has it; of a plane that is cut off at the edge; that of other cells.
TEST_F(BackdropWarpTest, NearnessIsThatOfTheFrame) {
  const world::Camera before = cameraOf(636, 364);
  const auto backdrop = backdropOf(floorAt, before, {-80, -80, 720, 440});
  for (const float step : {0.0F, 0.4F}) {
    world::Camera after = before;
    after.pose.position += step * world::Vec3(0.5F, 0.3F, -1.0F);
    after.pose.yaw += 0.1F * step;
    const Shown shown = show(*backdrop, after);
    ASSERT_EQ(shown.nearness->across(), 80);
    ASSERT_EQ(shown.nearness->down(), 46);
    const auto wanted = testing::paint(floorAt, after, shown.picture->rect);
    expectNearness(*shown.nearness, *wanted, shown.picture->rect);
    // Of cells that the frame holds in part.
    for (int row = 0; row < 46; ++row) {
      ASSERT_NEAR(shown.nearness->row(row)[79] / shown.nearness->row(row)[78], 1.0F, 0.05F) << row;
    }
    for (std::size_t i = 0; i < 80; ++i) {
      ASSERT_NEAR(shown.nearness->row(45)[i] / shown.nearness->row(44)[i], 1.0F, 0.05F) << i;
    }
  }
}

TEST_F(BackdropWarpTest, SkyHasNoNearness) {
  const world::Camera before = cameraOf(640, 360);
  const auto backdrop = backdropOf(skyAt, before, {-40, -40, 680, 400});
  world::Camera after = before;
  after.pose.yaw += 0.02F;
  after.pose.position.z -= 1.0F;
  const Shown shown = show(*backdrop, after);
  for (const float each : shown.nearness->cells()) ASSERT_EQ(each, 0.0F);
}

/// Fails if it overwrites what is measured after all layers.
TEST_F(BackdropWarpTest, LeavesTheNearnessOfFreshParts) {
  const world::Camera camera = cameraOf(640, 360);
  const auto backdrop = backdropOf(wallAt, camera, {0, 0, 640, 360});
  const Shown shown = show(*backdrop, camera, {{300, 100, 301, 101}});
  EXPECT_EQ(shown.nearness->row(12)[32], kPoisonNearness);
  EXPECT_EQ(shown.nearness->row(12)[63], kPoisonNearness);
  EXPECT_NEAR(shown.nearness->row(12)[31], 0.2F, 0.001F);
  EXPECT_NEAR(shown.nearness->row(12)[64], 0.2F, 0.001F);
  EXPECT_NEAR(shown.nearness->row(11)[32], 0.2F, 0.001F);
}

/// Fails if the corner cells of an outline are stretched between what is in front and what is behind.
TEST_F(BackdropWarpTest, PostOutlineStaysStraight) {
  const Painter post = [](const world::Camera& camera, world::Vec3 ray) {
    const world::Vec3 point = camera.pose.position + 2.0F * ray;
    return std::abs(point.x) < 0.3F ? Pixel{0xFFFFFFFFU, 2.0F} : Pixel{0xFF000000U, 40.0F};
  };
  const world::Camera before = cameraOf(640, 360);
  const auto backdrop = backdropOf(post, before, {-20, -20, 660, 380});
  world::Camera after = before;
  after.pose.position.x += 0.04F;
  tests::onEachTarget([&] {
    const Shown shown = show(*backdrop, after);
    for (int y = 0; y < 360; ++y) {
      const std::uint8_t* const row = shown.picture->y() + y * 640;
      const auto first = std::find_if(row, row + 640, [](std::uint8_t luma) { return luma > 127U; });
      const float left = 320.0F + after.focal() * (-0.3F - 0.04F) / 2.0F;
      ASSERT_NEAR(static_cast<float>(first - row), left, 1.0F) << y;
      const auto end = std::find_if(first, row + 640, [](std::uint8_t luma) { return luma <= 127U; });
      ASSERT_NEAR(static_cast<float>(end - first), after.focal() * 0.3F, 1.0F) << y;
    }
  });
}

}  // namespace
}  // namespace grove::node
