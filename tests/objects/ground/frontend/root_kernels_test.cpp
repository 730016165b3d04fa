#include "objects/ground/frontend/root_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "each_target.h"

namespace grove::objects::ground {
namespace {

constexpr int kRootRow = 300;

/// Blades that mostly stay below the row, and in every fifth row all do.
void grow(int reach, std::mt19937& random, GrassRows& grass) {
  for (int above = 1; above <= reach; ++above) {
    const auto slot = static_cast<std::size_t>((kRootRow + above) % kRootRows);
    std::int16_t highest = kRootRow + kRootRows;
    for (std::size_t column = 0; column < kTile; ++column) {
      const int under = above % 5 == 0 ? 1 : random() % 40 == 0 ? 0 : 1;
      const auto top = static_cast<std::int16_t>(under > 0 ? kRootRow + 1 + static_cast<int>(random() % 3) : kRootRow);
      grass.tops[slot * kTile + column] = top;
      highest = std::min(highest, top);
    }
    grass.highest[slot] = highest;
  }
}

int rootAbove(const GrassRows& grass, int reach, std::size_t column) {
  for (int above = reach; above > 0; --above) {
    if (grass.tops[static_cast<std::size_t>((kRootRow + above) % kRootRows) * kTile + column] <= kRootRow) return above;
  }
  return 0;
}

float relief(const Row& row, int above) {
  const float height = (static_cast<float>(above) + 0.5F) / (row.pixelsPerMetre * 0.62F * kTallest);
  const float stalk = std::sqrt(std::min(1.0F, height));
  return 0.548F + 0.86F * stalk - 0.25F * stalk * stalk;
}

/// Tolerance of shares: what the lower bits take, and rounding.
TEST(RootKernels, FindsTheNearestBladeAndItsShare) {
  const auto soil = std::make_unique<FineSoil>();
  const auto step = std::make_unique<FineSoil>();
  for (std::size_t column = 0; column < kTile; ++column) {
    soil->grass[column] = static_cast<std::int16_t>(column * 40);
    step->grass[column] = static_cast<std::int16_t>(column * 20);
  }
  tests::onEachTarget([&] {
    std::mt19937 random(9);
    const auto grass = std::make_unique<GrassRows>();
    for (const int reach : {0, 1, 3, 17, 126}) {
      for (const float pixelsPerMetre : {3.0F, 25.0F, 400.0F}) {
        Row row;
        row.row = kRootRow;
        row.pixelsPerMetre = pixelsPerMetre;
        grow(reach, random, *grass);
        findRoots(row, reach, {*soil, *step, 3}, *grass);
        const float tops = std::clamp(1.5F - 0.5F * pixelsPerMetre * 0.35F * kTallest, 0.0F, 1.0F);
        for (std::size_t column = 0; column < kTile; ++column) {
          const int above = rootAbove(*grass, reach, column);
          const Root root = grass->roots[column];
          ASSERT_EQ(static_cast<int>(root & kRootMask), above) << reach << ' ' << column;
          const float cover = std::min(1.0F, 4.0F * static_cast<float>(column * 100) / 32768.0F);
          const float seen = above == 0 ? std::max(1.0F - cover, tops) : tops;
          const float share = relief(row, above) + (1.0F - relief(row, above)) * seen;
          ASSERT_NEAR(static_cast<float>(root & ~kRootMask), share * kShareSteps, 1.1F * kRootRows)
              << reach << ' ' << column;
        }
      }
    }
  });
}

}  // namespace
}  // namespace grove::objects::ground
