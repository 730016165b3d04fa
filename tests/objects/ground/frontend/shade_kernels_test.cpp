#include "objects/ground/frontend/shade_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>

#include "each_target.h"
#include "objects/ground/frontend/sampled_soil.h"

namespace grove::objects::ground {
namespace {

constexpr int kRow = 126;

int aboveAt(int column) { return column * 7 % 100; }
float shareAt(int column) { return 0.55F + 0.45F * static_cast<float>(column % 16) / 16.0F; }
std::array<std::uint32_t, 3> texelAt(int column) {
  const auto byte = static_cast<std::uint32_t>(column * 37 % 256);
  return {byte, 255U - byte, 90U};
}

/// Of ground that rises to the right.
float inverseAt(int row, int column) {
  return -0.1F + 0.002F * static_cast<float>(row) + 1e-4F * static_cast<float>(column);
}

/// What grows where, and as what it is to be seen.
std::unique_ptr<GrassRows> grown() {
  auto grass = std::make_unique<GrassRows>();
  for (int column = 0; column < kTile; ++column) {
    const auto [red, green, blue] = texelAt(column);
    const auto slot = static_cast<std::size_t>((kRow + aboveAt(column)) % kRootRows);
    grass->texels[slot * kTile + static_cast<std::size_t>(column)] = red | green << 8U | blue << 16U | 128U << 24U;
    const int share = static_cast<int>(shareAt(column) * kShareSteps / kRootRows);
    grass->roots[static_cast<std::size_t>(column)] = static_cast<Root>(share * kRootRows + aboveAt(column));
  }
  for (int row = kRow; row < kRow + kRootRows; ++row) {
    for (int sample = 0; sample < kCoarseSamples; ++sample) {
      const auto slot = static_cast<std::size_t>(row % kRootRows);
      grass->inverseDepths[slot * kCoarsePadded + static_cast<std::size_t>(sample)] = inverseAt(row, sample * kCoarse);
    }
  }
  return grass;
}

/// Tolerance of colours: the steps of 16-bit numbers, of shares and of the table make up to one and a half of a byte's.
TEST(ShadeKernels, MatchTheParabola) {
  const SampledSoil top = soilWith(0.0F);
  const SampledSoil bottom = soilWith(0.7F);
  const std::unique_ptr<GrassRows> grass = grown();
  tests::onEachTarget([&] {
    const auto soil = std::make_unique<std::array<FineSoil, 3>>();
    auto& [first, last, step] = *soil;
    spreadSoil(top, first);
    spreadSoil(bottom, last);
    stepSoil(first, last, 2, step);
    std::array<std::uint32_t, kTile> colour{};
    std::array<float, kTile> depth{};
    shadeRow(kRow, {first, step, 1}, *grass, colour.data(), depth.data());
    for (int column = 0; column < kTile; ++column) {
      const auto at = static_cast<std::size_t>(column);
      const auto mean = [&](const SoilSamples& above, const SoilSamples& below) {
        return 0.5F * (lineAt(above, column) + lineAt(below, column));
      };
      for (std::size_t channel = 0; channel < 3; ++channel) {
        const float q = static_cast<float>(texelAt(column)[channel]) * shareAt(column) * kMeadowStep;
        const SampledSoil::Channel& above = top.channels[channel];
        const SampledSoil::Channel& below = bottom.channels[channel];
        const float exact =
            (mean(above.square, below.square) * q + mean(above.slope, below.slope)) * q + mean(above.base, below.base);
        const auto shown = static_cast<float>((colour[at] >> (8U * channel)) & 0xFFU) + 0.5F;
        ASSERT_NEAR(shown, std::clamp(exact, 0.0F, 255.5F), 1.8F) << column << ' ' << channel;
      }
      ASSERT_EQ(colour[at] >> 24U, 0xFFU);
      const float plane = 1.0F / inverseAt(kRow + aboveAt(column), column);
      ASSERT_NEAR(depth[at], plane, 1e-5F * plane) << column;
    }
  });
}

}  // namespace
}  // namespace grove::objects::ground
