#include "objects/lightfield/relight_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "each_target.h"

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

constexpr int kStride = 70;
constexpr std::uint32_t kUntouched = 0x12345678U;

std::size_t texelAt(int row, int column) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(kStride) + static_cast<std::size_t>(column);
}

/// A picture with holes; a part of it begins at its first pixel.
struct Picture {
  std::vector<std::uint32_t> colour;
  std::vector<float> depth;
  ObjectCamera camera;

  explicit Picture(const world::Rect& rect) : colour(kStride * 20, kUntouched), depth(kStride * 20, 0.001F) {
    std::mt19937 random(9);
    camera.eye = {0.3F, 1.5F, 4.0F};
    camera.corner = {-0.7F, 0.4F, -1.0F};
    camera.perColumn = {0.02F, 0.001F, 0.0F};
    camera.perRow = {0.001F, -0.02F, 0.002F};
    for (int row = 0; row < rect.height(); ++row) {
      for (int column = 0; column < rect.width(); ++column) {
        const auto at = texelAt(row, column);
        const bool hole = random() % 3 == 0;
        const std::uint32_t alpha = hole ? 0 : 1 + random() % 255;
        colour[at] = alpha << 24U;
        for (std::uint32_t shift = 0; shift < 24; shift += 8) colour[at] |= random() % (alpha + 1) << shift;
        depth[at] = hole ? world::kInfiniteDepth : 1.0F + static_cast<float>(random() % 1000) * 0.005F;
      }
    }
  }

  [[nodiscard]] PicturePart part(const world::Rect& rect) { return {colour.data(), depth.data(), kStride, rect}; }
};

/// Calls expect(pixel before, pixel after, point) for all pixels of the part that show something; the others must be
/// as they were.
template <typename Expect>
void compare(const Picture& before, const Picture& after, const world::Rect& rect, const Expect& expect) {
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < kStride; ++column) {
      const auto at = texelAt(row, column);
      const bool within = row < rect.height() && column < rect.width();
      if (!within || before.colour[at] == 0) {
        ASSERT_EQ(after.colour[at], before.colour[at]) << column << ", " << row;
        continue;
      }
      const Vec3 ray =
          before.camera.ray(static_cast<float>(rect.left + column) + 0.5F, static_cast<float>(rect.top + row) + 0.5F);
      ASSERT_EQ(after.colour[at] >> 24U, before.colour[at] >> 24U);
      expect(before.colour[at], after.colour[at], before.camera.eye + before.depth[at] * ray);
    }
  }
}

float channel(std::uint32_t pixel, std::size_t i) { return static_cast<float>(pixel >> (8U * i) & 255U); }

const std::array<world::Rect, 4> kRects{world::Rect{5, 3, 6, 4}, world::Rect{0, 0, 16, 8}, world::Rect{7, 1, 24, 20},
                                        world::Rect{2, 2, 69, 9}};

/// Tolerance: half a step for the rounding and a little for where it falls.
constexpr float kTolerance = 0.51F;

/// Fails if a target takes another sample or weight, or leaves a row's end out or goes beyond it.
TEST(RelightKernels, EveryTargetShadesAsAPlainLoopDoes) {
  SunGrid sun;
  sun.cells = {5, 4, 3};
  sun.low = {-2.0F, -1.0F, -2.0F};
  sun.perMetre = {1.1F, 0.7F, 0.4F};
  std::mt19937 random(3);
  for (int i = 0; i < 5 * 4 * 3; ++i) sun.sun.push_back(static_cast<float>(random() % 5) * 0.25F);
  sun.whole = false;
  const auto shareAt = [&](Vec3 point) {
    Vec3 place = (point - sun.low) * sun.perMetre;
    int cell[3];
    for (int axis = 0; axis < 3; ++axis) {
      const auto last = static_cast<float>(sun.cells[static_cast<std::size_t>(axis)] - 1);
      place[axis] = std::clamp(place[axis], 0.0F, last - 0.001F);
      cell[axis] = static_cast<int>(place[axis]);
    }
    float share = 0.0F;
    for (int corner = 0; corner < 8; ++corner) {
      float weight = 1.0F;
      std::size_t at[3];
      for (int axis = 0; axis < 3; ++axis) {
        const int next = corner >> axis & 1;
        const float beyond = place[axis] - static_cast<float>(cell[axis]);
        at[axis] = static_cast<std::size_t>(cell[axis]) + static_cast<std::size_t>(next);
        weight *= next != 0 ? beyond : 1.0F - beyond;
      }
      share += weight * sun.sun[(at[2] * 4 + at[1]) * 5 + at[0]];
    }
    return share;
  };
  tests::onEachTarget([&] {
    for (const world::Rect& rect : kRects) {
      const Picture before(rect);
      Picture after = before;
      shadePart(sun, after.camera, after.part(rect));
      compare(before, after, rect, [&](std::uint32_t was, std::uint32_t is, Vec3 point) {
        const float share = shareAt(point);
        const float shade[3] = {0.50F, 0.62F, 0.78F};
        for (std::size_t i = 0; i < 3; ++i) {
          ASSERT_NEAR(channel(is, i), channel(was, i) * (shade[i] + (1.0F - shade[i]) * share), kTolerance);
        }
      });
    }
  });
}

/// Fails if a target adds another lamp's light, or more than the coverage.
TEST(RelightKernels, EveryTargetLightsAsAPlainLoopDoes) {
  const std::array<world::PointLight, 3> lamps{world::PointLight{{0.5F, 1.0F, 1.0F}, {1.0F, 0.5F, 0.2F}},
                                               world::PointLight{{-2.0F, 2.0F, 0.0F}, {0.1F, 0.7F, 3.0F}},
                                               world::PointLight{{9.0F, 6.0F, 3.0F}, {4.0F, 2.0F, 2.0F}}};
  tests::onEachTarget([&] {
    for (const world::Rect& rect : kRects) {
      const Picture before(rect);
      Picture after = before;
      lightPart(lamps, after.camera, after.part(rect));
      compare(before, after, rect, [&](std::uint32_t was, std::uint32_t is, Vec3 point) {
        Vec3 gain(0.0F);
        for (const world::PointLight& lamp : lamps) {
          const float squared = glm::dot(lamp.position - point, lamp.position - point);
          const float fade = std::max(1.0F - squared / 49.0F, 0.0F);
          gain += lamp.colour * (fade * fade / (squared + 0.6F));
        }
        for (std::size_t i = 0; i < 3; ++i) {
          const float lit = channel(was, i) * (1.0F + gain[static_cast<int>(i)]);
          ASSERT_NEAR(channel(is, i), std::min(lit, channel(was, 3)), kTolerance);
        }
      });
    }
  });
}

/// Fails if a target counts pixels that show nothing or that are beside the part, or leaves some out.
TEST(RelightKernels, EveryTargetFindsTheRangeOfDepths) {
  tests::onEachTarget([] {
    for (const world::Rect& rect : kRects) {
      Picture picture(rect);
      float nearest = kRelightFarthest;
      float farthest = 0.0F;
      for (int i = 0; i < rect.width() * rect.height(); ++i) {
        const auto at = texelAt(i / rect.width(), i % rect.width());
        if (picture.colour[at] == 0) continue;
        nearest = std::min(nearest, picture.depth[at]);
        farthest = std::max(farthest, picture.depth[at]);
      }
      const DepthRange range = depthRange(picture.part(rect));
      EXPECT_EQ(range.nearest, nearest);
      EXPECT_EQ(range.farthest, farthest);
    }
  });
}

}  // namespace
}  // namespace grove::objects::lightfield
