#include "objects/lightfield/common/cached_view_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "each_target.h"

namespace grove::objects::lightfield {
namespace {

constexpr int kWidths[] = {1, 2, 3, 7, 16, 17, 33, 100};
constexpr float kBeyond = -7.0F;

/// Nearnesses with many zeros, and one value beyond the end.
std::vector<float> nearnesses(int width, std::mt19937& random) {
  std::vector<float> row;
  for (int i = 0; i < width; ++i) row.push_back(random() % 2 == 0 ? 0.0F : static_cast<float>(random() % 64) * 0.01F);
  row.push_back(kBeyond);
  return row;
}

std::vector<std::uint32_t> colours(int width, std::mt19937& random) {
  std::vector<std::uint32_t> row;
  for (int i = 0; i < width; ++i) row.push_back(random() % 3 == 0 ? 0x00FFFFFFU : (random() % 256 << 24U) + 5U);
  return row;
}

/// Fails if a target misses the first or the last covered pixel, or counts one that shows nothing.
TEST(CachedViewKernels, CoverageMatchesScalarOnEveryTarget) {
  tests::onEachTarget([] {
    std::mt19937 random(2);
    for (const int width : kWidths) {
      for (int repeat = 0; repeat < 8; ++repeat) {
        std::vector<std::uint32_t> colour(static_cast<std::size_t>(width), 0U);
        std::vector<float> depth(static_cast<std::size_t>(width), 0.5F);
        CoveredSpan expected{width, 0};
        for (int count = repeat; count > 0; --count) {
          const int x = static_cast<int>(random() % static_cast<std::uint32_t>(width));
          const auto at = static_cast<std::size_t>(x);
          const bool far = random() % 4 == 0;
          colour[at] = 0x01000000U;
          if (depth[at] == 0.5F) depth[at] = far ? world::kInfiniteDepth : 1.0F + static_cast<float>(random() % 9);
          if (depth[at] == world::kInfiniteDepth) continue;
          expected.begin = std::min(expected.begin, x);
          expected.end = std::max(expected.end, x + 1);
          expected.nearest = std::min(expected.nearest, depth[at]);
        }
        const CoveredSpan span = coveredSpan(colour.data(), depth.data(), width);
        EXPECT_EQ(span.begin, expected.begin);
        EXPECT_EQ(span.end, expected.end);
        EXPECT_EQ(span.nearest, expected.nearest);
      }
    }
  });
}

/// Fails if a target takes another neighbour, or treats an end of the row otherwise.
TEST(CachedViewKernels, RowsMatchScalarOnEveryTarget) {
  constexpr float kSoftness = 2.0F;
  tests::onEachTarget([] {
    std::mt19937 random(4);
    for (const int width : kWidths) {
      const std::vector<float> near = nearnesses(width, random);
      std::vector<float> wide(near.size(), kBeyond);
      widenRow(near.data(), width, wide.data());
      for (std::size_t x = 0; x < near.size(); ++x) {
        const bool within = x > 0 && x + 2 < near.size();
        ASSERT_EQ(wide[x], within ? std::max({near[x - 1], near[x], near[x + 1]}) : kBeyond) << width;
      }

      const std::vector<float> above = nearnesses(width, random);
      const std::vector<float> here = nearnesses(width, random);
      const std::vector<float> below = nearnesses(width, random);
      const std::vector<std::uint32_t> colour = colours(width, random);
      std::vector<float> ranked = near;
      rankRow(above.data(), here.data(), below.data(), colour.data(), width, kSoftness, ranked.data());
      for (std::size_t x = 0; x < colour.size(); ++x) {
        const float own = near[x] > 0.0F ? near[x] : std::max({above[x], here[x], below[x]});
        ASSERT_EQ(ranked[x], colour[x] >> 24U >= 128U ? own : own - kSoftness) << width;
      }
      ASSERT_EQ(ranked.back(), kBeyond);

      std::vector<float> min(near.size(), 0.2F);
      std::vector<float> max(near.size(), 0.3F);
      widenRanges(ranked.data(), width, kSoftness, min.data(), max.data());
      for (std::size_t x = 0; x < colour.size(); ++x) {
        const float value = ranked[x] < 0.0F ? ranked[x] + kSoftness : ranked[x];
        ASSERT_EQ(min[x], value > 0.0F ? std::min(0.2F, value) : 0.2F);
        ASSERT_EQ(max[x], std::max(0.3F, value));
      }
      ASSERT_EQ(min.back(), 0.2F);
      ASSERT_EQ(max.back(), 0.3F);
    }
  });
}

}  // namespace
}  // namespace grove::objects::lightfield
