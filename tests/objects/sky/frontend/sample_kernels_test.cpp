#include "objects/sky/frontend/sample_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "each_target.h"
#include "objects/sky/common/ramps.h"
#include "world/camera.h"

namespace grove::objects::sky {
namespace {

RowOfRays raysOf(const world::Camera& camera, int row) {
  const float pitch = camera.pose.pitch;
  const float v =
      (1.0F - 2.0F * (static_cast<float>(row) + 0.5F) / static_cast<float>(camera.height)) * camera.tanHalfY();
  const float step = 2.0F * camera.tanHalfX() / static_cast<float>(camera.width);
  return {camera.pose.yaw, std::cos(pitch) - v * std::sin(pitch), std::sin(pitch) + v * std::cos(pitch),
          0.5F * step - camera.tanHalfX(), step};
}

void expectRowsOf(const Panorama& panorama, const world::Camera& camera) {
  for (const int row : {0, camera.height / 3, camera.height / 2 - 1}) {
    std::vector<std::uint32_t> colour(static_cast<std::size_t>(camera.width));
    sampleRow(panorama, raysOf(camera, row), 0, camera.width, colour.data());
    for (int x = 0; x < camera.width; ++x) {
      const auto expected =
          panorama.sample(glm::normalize(camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(row) + 0.5F)));
      const std::uint32_t got = colour[static_cast<std::size_t>(x)];
      ASSERT_NEAR(static_cast<float>(got & 0xFFU), expected.r, 3.0F) << row << ' ' << x;
      ASSERT_NEAR(static_cast<float>((got >> 8U) & 0xFFU), expected.g, 3.0F) << row << ' ' << x;
      ASSERT_EQ(got >> 24U, 0xFFU);
    }
  }
}

/// Tolerance: 256ths of a texel, and paths that are joined from knots 0.6 texels, of 2 steps each.
TEST(SampleKernels, RowsMatchTheReference) {
  const Panorama panorama = ramps();
  tests::onEachTarget([&] {
    // In fine rows most places are joined from knots, in coarse ones each is worked out.
    for (const int width : {160, 1280}) {
      for (const float yaw : {0.0F, 0.7F, 1.6F, 3.1F, -2.9F, -0.01F}) {
        for (const float pitch : {-0.3F, 0.0F, 0.5F, 1.2F, 1.5F}) {
          SCOPED_TRACE(testing::Message() << width << ' ' << yaw << ' ' << pitch);
          expectRowsOf(panorama, {.pose = {.yaw = yaw, .pitch = pitch}, .width = width, .height = width * 9 / 16});
        }
      }
    }
  });
}

TEST(SampleKernels, PartsEqualTheWholeAndStayInBounds) {
  constexpr std::uint32_t kUntouched = 0x12345678U;
  const Panorama panorama = ramps();
  const world::Camera camera{.pose = {.yaw = 0.4F, .pitch = 0.2F}, .width = 1280, .height = 720};
  const RowOfRays rays = raysOf(camera, 100);
  tests::onEachTarget([&] {
    std::vector<std::uint32_t> whole(1280);
    sampleRow(panorama, rays, 0, 1280, whole.data());
    for (const auto& [first, count] : {std::pair{0, 1}, {255, 2}, {3, 5}, {37, 600}, {1265, 15}}) {
      std::vector<std::uint32_t> part(static_cast<std::size_t>(count) + 1, kUntouched);
      sampleRow(panorama, rays, first, count, part.data());
      EXPECT_TRUE(std::equal(part.begin(), part.end() - 1, whole.begin() + first)) << first << ' ' << count;
      EXPECT_EQ(part.back(), kUntouched) << first << ' ' << count;
    }
  });
}

std::uint32_t mixed(std::uint32_t a, std::uint32_t b, std::uint32_t weight) {
  std::uint32_t result = 0;
  for (std::uint32_t shift = 0; shift < 32; shift += 8) {
    const std::uint32_t sum = ((a >> shift) & 0xFFU) * (256 - weight) + ((b >> shift) & 0xFFU) * weight;
    result |= (sum + 128) / 256 << shift;
  }
  return result;
}

TEST(SampleKernels, RowsAreWidenedExactly) {
  tests::onEachTarget([] {
    std::mt19937 random(3);
    for (const int step : {2, 4}) {
      for (const int count : {1, 2, 7, 64, 333}) {
        std::vector<std::uint32_t> above(static_cast<std::size_t>(count / step + 2));
        std::vector<std::uint32_t> below(above.size());
        std::ranges::generate(above, random);
        std::ranges::generate(below, random);
        std::vector<std::uint32_t> colour(static_cast<std::size_t>(count + step));
        widenRow(above.data(), below.data(), step, count, colour.data());
        for (int x = 0; x < count; ++x) {
          const auto at = static_cast<std::size_t>(x / step);
          const std::uint32_t left = mixed(above[at], below[at], 128);
          const std::uint32_t right = mixed(above[at + 1], below[at + 1], 128);
          ASSERT_EQ(colour[static_cast<std::size_t>(x)],
                    mixed(left, right, static_cast<std::uint32_t>(256 / step * (x % step))))
              << step << ' ' << count << ' ' << x;
        }
      }
    }
  });
}

}  // namespace
}  // namespace grove::objects::sky
