#include "objects/figure/backend/shadow/shade_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "each_target.h"
#include "world/camera.h"

namespace grove::objects::figure {
namespace {

constexpr int kCounts[] = {1, 3, 8, 17, 40};
constexpr int kSide = 6;  // texels

std::vector<std::uint16_t> randomTexels(std::mt19937& random) {
  std::vector<std::uint16_t> texels;
  texels.reserve(std::size_t{kSide} * kSide);
  for (int i = 0; i < kSide * kSide; ++i) texels.push_back(static_cast<std::uint16_t>(random()));
  return texels;
}

float texelAt(const std::vector<std::uint16_t>& texels, float column, float row) {
  const float x = std::clamp(column, 0.0F, kSide - 1.001F);
  const float y = std::clamp(row, 0.0F, kSide - 1.001F);
  const auto at = static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x);
  const auto mixed = [&](std::size_t first) {
    return std::lerp(static_cast<float>(texels[first]), static_cast<float>(texels[first + 1]), x - std::floor(x));
  };
  return std::lerp(mixed(at), mixed(at + kSide), y - std::floor(y)) / 65535.0F;
}

/// Fails if a target takes another texel, weight or place, or changes what follows the last.
TEST(ShadeKernels, AddInterpolatedTexelsOnEveryTarget) {
  tests::onEachTarget([] {
    std::mt19937 random(7);
    const std::vector<std::uint16_t> texels = randomTexels(random);
    for (const int count : kCounts) {
      const TexelLine line{texels.data(), kSide, kSide, {-0.7F, 5.3F}, {0.21F, -0.17F}};
      std::vector<float> sums(static_cast<std::size_t>(count) + kShadePadding, 0.25F);
      addTexels(line, 0.5F, count, sums.data());
      for (std::size_t i = 0; i < sums.size(); ++i) {
        const float place = static_cast<float>(i);
        const float texel = texelAt(texels, -0.7F + 0.21F * place, 5.3F - 0.17F * place);
        const bool isIn = i < static_cast<std::size_t>(count);
        ASSERT_NEAR(sums[i], 0.25F + (isIn ? 0.5F * texel : 0.0F), 1e-4F) << i;
      }
    }
  });
}

struct Pixel {
  std::uint32_t colour;
  float depth;
};

/// As layShades() describes it.
Pixel shaded(const Pixel& before, float sun, float sky, const ShadeLook& look) {
  const float opacity = std::max(sun, sky);
  if (opacity < 0.5F / 255.0F) return before;
  const bool isFree = before.depth >= world::kInfiniteDepth;
  const std::uint32_t over = isFree ? 0U : before.colour;
  const float share = 1.0F - static_cast<float>(over >> 24U) / 255.0F;
  const auto channel = [&](float level, unsigned shift) {
    return static_cast<std::uint32_t>(std::lround(255.0F * level * share)) << shift;
  };
  const std::uint32_t behind = channel(sun * look.colour.r, 0) + channel(sun * look.colour.g, 8) +
                               channel(sun * look.colour.b, 16) + channel(opacity, 24);
  return {over + behind, isFree || sun > 0.1F ? std::min(before.depth, look.depth) : before.depth};
}

/// Fails if a target covers what is before the shade, forgets a channel, or writes beyond the end.
TEST(ShadeKernels, LieBehindPixelsOnEveryTarget) {
  tests::onEachTarget([] {
    std::mt19937 random(9);
    const ShadeLook look{{0.02F, 0.09F, 0.08F}, 5.0F};
    const auto share = [&] { return static_cast<float>(random() % 1000) / 1000.0F; };
    for (const int count : kCounts) {
      const auto size = static_cast<std::size_t>(count);
      std::vector<float> sun(size + kShadePadding);
      std::vector<float> sky(size + kShadePadding);
      std::vector<std::uint32_t> colour(size + 1, 0xDEADBEEFU);
      std::vector<float> depth(size + 1, 1.0F);
      std::vector<Pixel> expected;
      for (std::size_t i = 0; i < size; ++i) {
        sun[i] = random() % 4 == 0 ? 0.0F : 0.7F * share();
        sky[i] = random() % 4 == 0 ? 0.0F : 0.6F * share();
        const std::uint32_t coverage[] = {0xFF102030U, 0x80081018U, 0x30010203U};
        colour[i] = coverage[random() % 3];
        depth[i] = random() % 2 == 0 ? world::kInfiniteDepth : 4.0F + 2.0F * share();
        expected.push_back(shaded({colour[i], depth[i]}, sun[i], sky[i], look));
      }
      layShades(sun.data(), sky.data(), look, count, colour.data(), depth.data());
      for (std::size_t i = 0; i < size; ++i) {
        ASSERT_EQ(depth[i], expected[i].depth) << i;
        for (unsigned shift = 0; shift < 32; shift += 8) {
          ASSERT_NEAR(static_cast<double>(colour[i] >> shift & 0xFFU),
                      static_cast<double>(expected[i].colour >> shift & 0xFFU), 1.0)
              << i << ' ' << shift;
        }
      }
      EXPECT_EQ(colour.back(), 0xDEADBEEFU);
      EXPECT_EQ(depth.back(), 1.0F);
    }
  });
}

}  // namespace
}  // namespace grove::objects::figure
