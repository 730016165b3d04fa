#include "objects/ground/soil_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "objects/ground/shade_rows.h"

namespace grove::objects::ground {
namespace {

/// Curves as strong as those of grass in the sun and as those in the dark, with all between.
SampledSoil soilWith(float phase) {
  SampledSoil soil;
  for (std::size_t i = 0; i < soil.grass.size(); ++i) {
    const float wave = 0.5F + 0.5F * std::sin(0.4F * static_cast<float>(i) + phase);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const float strength = wave * (1.0F - 0.2F * static_cast<float>(channel));
      soil.channels[channel].base[i] = 20.0F - 60.0F * strength;
      soil.channels[channel].slope[i] = 30.0F + 370.0F * strength;
      soil.channels[channel].square[i] = 20.0F - 140.0F * strength;
    }
    soil.grass[i] = wave;
  }
  return soil;
}

float lineAt(const SoilSamples& samples, int column) {
  const auto left = static_cast<std::size_t>(column / kCoarse);
  const float share = static_cast<float>(column % kCoarse) / kCoarse;
  return samples[left] + (samples[left + 1] - samples[left]) * share;
}

TEST(SoilRows, ColumnsLieOnLinesBetweenTheSamplesAndRowsBetweenTheRows) {
  const SampledSoil top = soilWith(0.3F);
  const SampledSoil bottom = soilWith(1.4F);
  const auto first = std::make_unique<FineSoil>();
  const auto last = std::make_unique<FineSoil>();
  const auto step = std::make_unique<FineSoil>();
  spreadSoil(top, *first);
  spreadSoil(bottom, *last);
  for (const int rows : {2, 4}) {
    stepSoil(*first, *last, rows, *step);
    for (int row = 0; row < rows; ++row) {
      const float share = static_cast<float>(row) / static_cast<float>(rows);
      for (int column = 0; column < kTile; ++column) {
        const auto at = static_cast<std::size_t>(column);
        const auto mixed = [&](const SoilSamples& a, const SoilSamples& b) {
          return lineAt(a, column) + (lineAt(b, column) - lineAt(a, column)) * share;
        };
        const auto fine = [&](const FineSoil::Line& from, const FineSoil::Line& by, std::size_t half) {
          return static_cast<float>(from[2 * at + half] + row * by[2 * at + half]);
        };
        ASSERT_NEAR(fine(first->low.base, step->low.base, 1) / kSoilSteps,
                    mixed(top.channels[2].base, bottom.channels[2].base), 0.25F);
        ASSERT_NEAR(fine(first->high.slope, step->high.slope, 0) * kSlopeStep,
                    mixed(top.channels[1].slope, bottom.channels[1].slope), 0.1F);
        ASSERT_NEAR(static_cast<float>(first->grass[at] + row * step->grass[at]) / kMostGrass,
                    mixed(top.grass, bottom.grass), 2e-4F);
      }
    }
  }
}

TEST(ShadeRow, AgreesWithTheParabolaAndShowsTheRootsDepth) {
  constexpr float kShare = 0.8F;
  constexpr int kAbove = 5;
  const SampledSoil samples = soilWith(0.0F);
  const auto soil = std::make_unique<FineSoil>();
  const auto level = std::make_unique<FineSoil>();
  spreadSoil(samples, *soil);
  Frame frame;
  frame.firstInverse = -0.1F;
  frame.inverseStep = 0.002F;
  Row row;
  row.row = 126;
  const auto grass = std::make_unique<GrassRows>();
  for (std::size_t i = 0; i < kTile; ++i) {
    const auto byte = static_cast<std::uint32_t>(i * 37 % 256);
    grass->texels[(126 + kAbove) % kRootRows * kTile + i] = byte | (255U - byte) << 8U | 90U << 16U | 128U << 24U;
    grass->roots[i] = static_cast<Root>(static_cast<int>(kShare * kShareSteps / kRootRows) * kRootRows + kAbove);
  }
  std::array<std::uint32_t, kTile> colour{};
  std::array<float, kTile> depth{};
  shadeRow(frame, row, {*soil, *level, 0}, *grass, colour.data(), depth.data());
  for (int column = 0; column < kTile; ++column) {
    const auto at = static_cast<std::size_t>(column);
    const float byte = static_cast<float>(column * 37 % 256);
    const std::array<float, 3> texel{byte, 255.0F - byte, 90.0F};
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const float q = texel[channel] * kShare * kMeadowStep;
      const SampledSoil::Channel& curve = samples.channels[channel];
      const float exact =
          (lineAt(curve.square, column) * q + lineAt(curve.slope, column)) * q + lineAt(curve.base, column);
      const auto shown = static_cast<float>((colour[at] >> (8U * channel)) & 0xFFU) + 0.5F;
      ASSERT_NEAR(shown, std::clamp(exact, 0.0F, 255.5F), 1.6F) << column << ' ' << channel;
    }
    ASSERT_EQ(colour[at] >> 24U, 0xFFU);
    ASSERT_NEAR(depth[at], 1.0F / (-0.1F + 0.002F * (126 + kAbove)), 1e-4F);
  }
}

}  // namespace
}  // namespace grove::objects::ground
