#include "stream/encode/h264/prediction/intra_fit_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <utility>

#include "each_target.h"

namespace grove::stream::h264 {
namespace {

int differenceOf(const MacroblockPixels& a, const MacroblockPixels& b) {
  int sum = 0;
  for (std::size_t i = 0; i < a.luma.size(); ++i) sum += std::abs(a.luma[i] - b.luma[i]);
  return sum;
}

/// What a mode predicts, with a little noise.
MacroblockPixels nearly(IntraMode mode, const ReferencePicture& picture, int column, int row, std::mt19937& random) {
  MacroblockPixels pixels{};
  predictIntraLuma(picture, column, row, mode, pixels);
  for (std::uint8_t& pixel : pixels.luma)
    pixel = static_cast<std::uint8_t>(std::min(255, pixel + static_cast<int>(random() % 4)));
  return pixels;
}

/// The first of the possible modes that fit best.
IntraFit plainBest(const ReferencePicture& picture, int column, int row, const MacroblockPixels& source) {
  IntraFit best{IntraMode::kMean, 1 << 30};
  for (const IntraMode mode : {IntraMode::kMean, IntraMode::kVertical, IntraMode::kHorizontal, IntraMode::kPlane}) {
    if (!isPossible(mode, column, row)) continue;
    MacroblockPixels predicted{};
    predictIntraLuma(picture, column, row, mode, predicted);
    const int difference = differenceOf(source, predicted);
    if (difference < best.difference) best = {mode, difference};
  }
  return best;
}

// Faults: a mode's prediction that is not what predictIntraLuma() makes, or that needs pixels outside of the picture.
TEST(IntraFitKernels, FindTheBestMode) {
  constexpr int kAlways = 1 << 28;
  tests::onEachTarget([] {
    std::mt19937 random(7);
    ReferencePicture picture(2, 2);
    for (int i = 0; i < 20; ++i) {
      const unsigned range = 1U + random() % 256U;
      std::ranges::generate(picture.plane(0).bytes, [&] { return static_cast<std::uint8_t>(random() % range); });
      for (const auto& [column, row] : {std::pair(0, 0), std::pair(1, 0), std::pair(0, 1), std::pair(1, 1)}) {
        for (const IntraMode like :
             {IntraMode::kMean, IntraMode::kVertical, IntraMode::kHorizontal, IntraMode::kPlane}) {
          if (!isPossible(like, column, row)) continue;
          const MacroblockPixels source = nearly(like, picture, column, row, random);
          const IntraFit expected = plainBest(picture, column, row, source);
          const IntraFit found = bestIntraLuma(picture, column, row, source, kAlways);
          EXPECT_EQ(found.mode, expected.mode);
          EXPECT_EQ(found.difference, expected.difference);
        }
      }
    }
  });
}

}  // namespace
}  // namespace grove::stream::h264
