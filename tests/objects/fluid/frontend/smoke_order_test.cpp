#include "objects/fluid/frontend/smoke_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace grove::objects::fluid {
namespace {

TEST(SmokeOrder, FarthestFirst) {
  std::mt19937 random(3);
  std::vector<float> depth(10'000);
  for (float& d : depth) d = 0.1F + 30.0F * static_cast<float>(random()) / 4294967296.0F;
  std::vector<std::uint32_t> sprites(depth.size());
  std::iota(sprites.begin(), sprites.end(), 0U);
  SmokeOrder().sortBackToFront(depth, sprites);
  const float step = 30.0F / 65535.0F;
  for (std::size_t i = 1; i < sprites.size(); ++i) ASSERT_GE(depth[sprites[i - 1]], depth[sprites[i]] - 1.01F * step);
  std::vector<std::uint32_t> all = sprites;
  std::sort(all.begin(), all.end());
  for (std::uint32_t i = 0; i < all.size(); ++i) ASSERT_EQ(all[i], i);
}

TEST(SmokeOrder, EqualDepthsKeepTheirOrder) {
  const std::vector<float> depth{2.0F, 5.0F, 2.0F, 5.0F, 2.0F};
  std::vector<std::uint32_t> sprites{0, 1, 2, 3, 4};
  SmokeOrder().sortBackToFront(depth, sprites);
  EXPECT_EQ(sprites, (std::vector<std::uint32_t>{1, 3, 0, 2, 4}));
}

TEST(SmokeOrder, SortsOnlyTheGivenOnes) {
  const std::vector<float> depth{1.0F, 9.0F, 3.0F, 4.0F};
  std::vector<std::uint32_t> sprites{0, 3, 2};
  SmokeOrder().sortBackToFront(depth, sprites);
  EXPECT_EQ(sprites, (std::vector<std::uint32_t>{3, 2, 0}));
  sprites = {2};
  SmokeOrder().sortBackToFront(depth, sprites);
  EXPECT_EQ(sprites, (std::vector<std::uint32_t>{2}));
}

}  // namespace
}  // namespace grove::objects::fluid
