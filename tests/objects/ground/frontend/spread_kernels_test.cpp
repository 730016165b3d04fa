#include "objects/ground/frontend/spread_kernels.h"

#include <gtest/gtest.h>

#include <memory>

#include "each_target.h"
#include "objects/ground/frontend/sampled_soil.h"

namespace grove::objects::ground {
namespace {

/// All lines of one pair of sampled rows; `row` is one of the `rows` between them.
struct Spread {
  const SampledSoil& top;
  const SampledSoil& bottom;
  const FineSoil& first;
  const FineSoil& step;
  int row;
  int rows;

  void expectLine(const FineSoil::Line& from, const FineSoil::Line& by, std::size_t half, float unit,
                  const SoilSamples& above, const SoilSamples& below, float tolerance) const {
    const float share = static_cast<float>(row) / static_cast<float>(rows);
    for (int column = 0; column < kTile; ++column) {
      const auto at = 2 * static_cast<std::size_t>(column) + half;
      const float exact = lineAt(above, column) + (lineAt(below, column) - lineAt(above, column)) * share;
      ASSERT_NEAR(static_cast<float>(from[at] + row * by[at]) * unit, exact, tolerance) << column;
    }
  }

  void expectChannels(const FineSoil::Channels& from, const FineSoil::Channels& by, std::size_t half,
                      std::size_t channel) const {
    SCOPED_TRACE(channel);
    const SampledSoil::Channel& above = top.channels[channel];
    const SampledSoil::Channel& below = bottom.channels[channel];
    expectLine(from.base, by.base, half, 1.0F / kSoilSteps, above.base, below.base, 0.25F);
    expectLine(from.slope, by.slope, half, kSlopeStep, above.slope, below.slope, 0.1F);
    expectLine(from.square, by.square, half, kSquareStep, above.square, below.square, 0.1F);
  }

  void expectGrass() const {
    const float share = static_cast<float>(row) / static_cast<float>(rows);
    for (int column = 0; column < kTile; ++column) {
      const auto at = static_cast<std::size_t>(column);
      const float above = lineAt(top.grass, column);
      ASSERT_NEAR(static_cast<float>(first.grass[at] + row * step.grass[at]) / kMaxGrass,
                  above + (lineAt(bottom.grass, column) - above) * share, 2e-4F)
          << column;
    }
  }
};

/// Tolerances: a few steps of the 16-bit numbers.
TEST(SpreadKernels, InterpolatesBetweenSamplesAndRows) {
  const SampledSoil top = soilWith(0.3F);
  const SampledSoil bottom = soilWith(1.4F);
  tests::onEachTarget([&] {
    const auto first = std::make_unique<FineSoil>();
    const auto last = std::make_unique<FineSoil>();
    const auto step = std::make_unique<FineSoil>();
    spreadSoil(top, *first);
    spreadSoil(bottom, *last);
    for (const int rows : {2, 4}) {
      stepSoil(*first, *last, rows, *step);
      for (int row = 0; row < rows; ++row) {
        const Spread spread{top, bottom, *first, *step, row, rows};
        spread.expectChannels(first->low, step->low, 0, 0);
        spread.expectChannels(first->high, step->high, 0, 1);
        spread.expectChannels(first->low, step->low, 1, 2);
        spread.expectGrass();
      }
    }
  });
}

}  // namespace
}  // namespace grove::objects::ground
