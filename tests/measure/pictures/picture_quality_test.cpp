#include "measure/pictures/picture_quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace grove::measure {
namespace {

constexpr int kWidth = 40;

std::uint32_t grey(int value) {
  const auto byte = static_cast<std::uint32_t>(std::clamp(value, 0, 255));
  return byte | byte << 8U | byte << 16U | 0xFF000000U;
}

using Pixels = std::vector<std::uint32_t>;

Picture picture(const Pixels& pixels) { return {pixels, kWidth}; }

/// Random greys around 128.
Pixels noise(int strength, unsigned seed) {
  std::mt19937 random(seed);
  Pixels pixels(std::size_t{kWidth} * 30);
  for (auto& pixel : pixels)
    pixel = grey(128 - strength + static_cast<int>(random() % (2 * static_cast<unsigned>(strength) + 1)));
  return pixels;
}

TEST(PictureQuality, EqualPicturesAreEqual) {
  const Pixels a = noise(60, 1);
  const Mask all(a.size(), 1);
  EXPECT_EQ(decibels(meanSquareError(picture(a), picture(a), all)), kEqual);
  EXPECT_NEAR(structuralSimilarity(picture(a), picture(a), all), 1.0, 1e-6);
}

TEST(PictureQuality, ConstantErrorHasItsSquareAsMean) {
  const Pixels a(400, grey(100));
  const Pixels b(400, grey(110));
  const Mask all(a.size(), 1);
  EXPECT_DOUBLE_EQ(meanSquareError(picture(a), picture(b), all), 100.0);
  EXPECT_NEAR(decibels(100.0), 28.1308, 1e-3);
}

TEST(PictureQuality, FlatPicturesHaveOnlyTheLumaTerm) {
  const Pixels a(std::size_t{kWidth} * 30, grey(100));
  const Pixels b(std::size_t{kWidth} * 30, grey(150));
  const double c1 = 6.5025;
  EXPECT_NEAR(structuralSimilarity(picture(a), picture(b), Mask(a.size(), 1)),
              (2.0 * 100 * 150 + c1) / (100.0 * 100 + 150 * 150 + c1), 2e-3);
}

TEST(PictureQuality, UnrelatedNoiseHasNoCommonStructure) {
  const Pixels a = noise(100, 1);
  const Pixels b = noise(100, 2);
  EXPECT_NEAR(structuralSimilarity(picture(a), picture(b), Mask(a.size(), 1)), 0.0, 0.1);
}

TEST(PictureQuality, OnlyTheMaskCounts) {
  const Pixels a = noise(60, 1);
  Pixels b = a;
  for (std::size_t i = 0; i < kWidth; ++i) b[i] = grey(0);
  Mask below(a.size(), 1);
  std::fill_n(below.begin(), kWidth, std::uint8_t{0});
  EXPECT_EQ(meanSquareError(picture(a), picture(b), below), 0.0);
  EXPECT_GT(meanSquareError(picture(a), picture(b), Mask(a.size(), 1)), 100.0);
}

TEST(PictureQuality, AnEmptyMaskHasNoError) {
  const Pixels a = noise(60, 1);
  const Pixels b = noise(60, 2);
  const Mask none(a.size(), 0);
  EXPECT_EQ(meanSquareError(picture(a), picture(b), none), 0.0);
  EXPECT_EQ(structuralSimilarity(picture(a), picture(b), none), 1.0);
}

TEST(PictureQuality, CoverageMakesTheMask) {
  const Pixels pixels{0x00000000U, 0x01000000U, 0xFF000000U, 0x00FFFFFFU};
  EXPECT_EQ(covered({pixels, 2}), (Mask{0, 1, 1, 0}));
}

}  // namespace
}  // namespace grove::measure
