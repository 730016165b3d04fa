#include "stream/encode/h264/prediction/fit_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "each_target.h"

namespace grove::stream::h264 {
namespace {

/// Luma of waves that move to the left and upwards.
MacroblockPixels waves(double left, double up) {
  MacroblockPixels pixels{};
  for (int y = 0; y < kMacroblock; ++y) {
    for (int x = 0; x < kMacroblock; ++x) {
      const double value = 128.0 + 50.0 * std::sin(0.5 * (x + left)) + 50.0 * std::cos(0.4 * (y + up));
      const int at = kMacroblock * y + x;
      pixels.luma[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(std::lround(value));
    }
  }
  return pixels;
}

// Faults: a step in the wrong direction, with x and y exchanged, of the wrong length, or along what has no gradient.
TEST(FitKernels, FindTheOffsetOfAPrediction) {
  tests::onEachTarget([] {
    for (const auto& [x, y] :
         {std::pair(0.25, 0.0), std::pair(0.0, -0.5), std::pair(-0.75, 0.5), std::pair(0.0, 0.0)}) {
      const Offset offset = offsetOf(waves(x, y), waves(0.0, 0.0));
      EXPECT_NEAR(offset.x, x, 0.08) << y;
      EXPECT_NEAR(offset.y, y, 0.08) << x;
    }
    MacroblockPixels stripes{};
    for (std::size_t i = 0; i < 256; ++i) stripes.luma[i] = static_cast<std::uint8_t>(i % 16 * 10);
    const Offset across = offsetOf(waves(0.0, 0.0), stripes);
    EXPECT_EQ(std::pair(across.x, across.y), std::pair(0.0F, 0.0F));
    const Offset flat = offsetOf(waves(0.0, 0.0), MacroblockPixels{});
    EXPECT_EQ(std::pair(flat.x, flat.y), std::pair(0.0F, 0.0F));
  });
}

}  // namespace
}  // namespace grove::stream::h264
