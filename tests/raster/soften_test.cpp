#include "raster/soften.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace grove::raster {
namespace {

constexpr int kSide = 9;
constexpr int kMiddle = 4;
constexpr std::uint32_t kWhite = 0xFFFFFFFFU;

/// Empty except for one white pixel in the middle, at 3 m.
std::shared_ptr<Image> dot(ImagePool& pool) {
  auto image = pool.acquire({-kMiddle, -kMiddle, kSide - kMiddle, kSide - kMiddle});
  std::ranges::fill(image->colour, 0U);
  std::ranges::fill(image->depth, world::kInfiniteDepth);
  image->colourRow(kMiddle)[kMiddle] = kWhite;
  image->depthRow(kMiddle)[kMiddle] = 3.0F;
  return image;
}

/// Fails if rows are softened in place before their neighbours have read them, or if a fringe stays without a depth.
TEST(Soften, ADotBecomesATent) {
  ImagePool pool;
  const auto image = dot(pool);
  soften(*image, Softening::kHalf);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const int away = std::max(std::abs(x - kMiddle), std::abs(y - kMiddle));
      const std::uint32_t colour = image->colourRow(y)[x];
      if (away > 1) {
        EXPECT_EQ(colour, 0U);
        EXPECT_EQ(image->depthRow(y)[x], world::kInfiniteDepth);
        continue;
      }
      const int halves = std::abs(x - kMiddle) + std::abs(y - kMiddle);
      EXPECT_NEAR(colour >> 24U, 255.0 / 4.0 * std::pow(0.5, halves), 2.0);
      EXPECT_EQ(colour & 0xFFU, colour >> 24U) << "premultiplied";
      EXPECT_EQ(image->depthRow(y)[x], 3.0F);
    }
  }
}

/// Fails if an image of one row or column reads beyond its ends.
TEST(Soften, NarrowImagesKeepPlainColours) {
  ImagePool pool;
  for (const world::Rect rect : {world::Rect{0, 0, 1, 1}, world::Rect{0, 0, 1, 5}, world::Rect{0, 0, 5, 1}}) {
    const auto image = pool.acquire(rect);
    std::ranges::fill(image->colour, 0x80402010U);
    std::ranges::fill(image->depth, 2.0F);
    soften(*image, Softening::kQuarter);
    for (const std::uint32_t colour : image->colour) EXPECT_EQ(colour, 0x80402010U);
    for (const float depth : image->depth) EXPECT_EQ(depth, 2.0F);
  }
}

}  // namespace
}  // namespace grove::raster
