#include "stream/encode/h264/adaptive_quantiser.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "each_target.h"
#include "stream/encode/h264/variance_kernels.h"

namespace grove::stream::h264 {
namespace {

/// Noise around grey; its standard deviation is about 0.58 `contrast`.
MacroblockPixels noise(int contrast, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> around(-contrast, contrast);
  MacroblockPixels pixels{};
  for (std::uint8_t& value : pixels.luma) value = static_cast<std::uint8_t>(127 + around(random));
  return pixels;
}

double plainVariance(const MacroblockPixels& pixels) {
  const double mean = std::accumulate(pixels.luma.begin(), pixels.luma.end(), 0.0) / 256.0;
  const auto add = [&](double sum, int value) { return sum + (value - mean) * (value - mean); };
  return std::accumulate(pixels.luma.begin(), pixels.luma.end(), 0.0, add) / 256.0;
}

TEST(Variance, IsThatOfAllPixelsOnEveryTarget) {
  MacroblockPixels extreme{};
  for (std::size_t i = 0; i < 256; ++i) extreme.luma[i] = i % 2 == 0 ? 0 : 255;
  MacroblockPixels white{};
  white.luma.fill(255);
  tests::onEachTarget([&] {
    for (unsigned seed = 0; seed < 50; ++seed) {
      const MacroblockPixels pixels = noise(static_cast<int>(seed) * 5 / 2, seed);
      EXPECT_NEAR(varianceOf(pixels), plainVariance(pixels), 0.01 + 1e-5 * plainVariance(pixels));
    }
    EXPECT_NEAR(varianceOf(extreme), 127.5 * 127.5, 0.01);
    EXPECT_NEAR(varianceOf(white), 0.0, 0.01);
  });
}

class AdaptiveQuantiserTest : public testing::Test {
 protected:
  /// Half of the picture has each contrast.
  void show(int smooth, int busy) {
    adaptive_.nextPicture();
    for (unsigned i = 0; i < 100; ++i) {
      smooth_ = adaptive_.choose(noise(smooth, i), 28);
      busy_ = adaptive_.choose(noise(busy, i), 28);
    }
  }

  AdaptiveQuantiser adaptive_;
  int smooth_ = 0;
  int busy_ = 0;
};

TEST_F(AdaptiveQuantiserTest, IsFinerWhereThePictureIsSmooth) {
  show(12, 48);
  show(12, 48);
  EXPECT_EQ(smooth_, 26);
  EXPECT_EQ(busy_, 30) << "four times the contrast: sixteen times the variance";
}

/// Fault: a picture of leaves takes a third of its bytes, one of sky three times as many.
TEST_F(AdaptiveQuantiserTest, KeepsThePicturesMean) {
  for (const int contrast : {8, 60}) {
    show(contrast, contrast);
    show(contrast, contrast);
    EXPECT_EQ(smooth_, 28) << contrast;
    EXPECT_EQ(busy_, 28) << contrast;
  }
}

TEST_F(AdaptiveQuantiserTest, HasLimits) {
  show(0, 127);
  show(0, 127);
  EXPECT_GE(smooth_, 28 - static_cast<int>(AdaptiveQuantiser::kMaxOffset));
  EXPECT_LE(busy_, 28 + static_cast<int>(AdaptiveQuantiser::kMaxOffset));
  EXPECT_EQ(adaptive_.choose(noise(127), 51), 51);
  EXPECT_EQ(adaptive_.choose(noise(0), 0), 0);
}

TEST_F(AdaptiveQuantiserTest, TakesNoiseForSmooth) {
  show(1, 40);
  const int noisy = adaptive_.choose(noise(1), 28);
  EXPECT_LE(noisy - adaptive_.choose(noise(0), 28), 1);
}

}  // namespace
}  // namespace grove::stream::h264
