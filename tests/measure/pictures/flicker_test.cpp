#include "measure/pictures/flicker.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace grove::measure {
namespace {

constexpr int kFilmWidth = 64;
constexpr int kFilmHeight = 40;  ///< two and a half blocks
constexpr double kFilmBlocks = 4.0 * 3.0;

/// A grey film, of which one block has the level that `level` says of each picture.
double flickerOf(int pictures, const std::function<int(int)>& level) {
  Flicker flicker;
  for (int t = 0; t < pictures; ++t) {
    std::vector<std::uint32_t> pixels;
    for (int y = 0; y < kFilmHeight; ++y) {
      for (int x = 0; x < kFilmWidth; ++x) {
        const bool inBlock = x >= 16 && x < 32 && y >= 32;
        const auto byte = static_cast<std::uint32_t>(inBlock ? level(t) : 100);
        pixels.push_back(0xFF000000U | byte << 16U | byte << 8U | byte);
      }
    }
    flicker.add({pixels, kFilmWidth});
  }
  return flicker.share();
}

TEST(Flicker, CountsAJumpOutAndBackOnce) {
  EXPECT_DOUBLE_EQ(flickerOf(10, [](int t) { return t == 4 ? 120 : 100; }), 1.0 / (kFilmBlocks * 8.0));
  EXPECT_DOUBLE_EQ(flickerOf(10, [](int t) { return t == 4 ? 80 : 100; }), 1.0 / (kFilmBlocks * 8.0));
}

TEST(Flicker, CountsAlternationInEveryPicture) {
  EXPECT_DOUBLE_EQ(flickerOf(10, [](int t) { return t % 2 == 0 ? 100 : 120; }), 1.0 / kFilmBlocks);
}

TEST(Flicker, IgnoresSteadyFades) {
  EXPECT_EQ(flickerOf(10, [](int t) { return 20 * t; }), 0.0);
}

TEST(Flicker, IgnoresLastingJumps) {
  EXPECT_EQ(flickerOf(10, [](int t) { return t < 4 ? 100 : 200; }), 0.0);
}

TEST(Flicker, IgnoresStillBlocks) {
  EXPECT_EQ(flickerOf(10, [](int) { return 100; }), 0.0);
}

TEST(Flicker, IgnoresTheThresholdItself) {
  EXPECT_EQ(flickerOf(3, [](int t) { return t == 1 ? 108 : 100; }), 0.0);
  EXPECT_GT(flickerOf(3, [](int t) { return t == 1 ? 109 : 100; }), 0.0);
}

TEST(Flicker, NeedsThreePictures) {
  EXPECT_EQ(flickerOf(2, [](int t) { return 200 * t; }), 0.0);
}

}  // namespace
}  // namespace grove::measure
