#include "objects/lightfield/backend/near/half_planes.h"

#include <gtest/gtest.h>

#include <bit>

namespace grove::objects::lightfield {
namespace {

std::uint32_t samplesOf(const HalfPlanes::Masks& masks, std::size_t distance) {
  return masks.low[distance] | static_cast<std::uint32_t>(masks.high[distance]) << 8U;
}

/// Fails if two faces with a common edge both draw a sample, or neither does.
TEST(HalfPlanes, TwoSidesShareNoSampleAndMissNone) {
  const HalfPlanes halfPlanes;
  for (std::int32_t slope = 0; slope < HalfPlanes::kSlopes; ++slope) {
    for (std::size_t i = 0; i < HalfPlanes::kDistances; ++i) {
      EXPECT_EQ(samplesOf(halfPlanes.at(slope), i) ^ samplesOf(halfPlanes.at(slope + HalfPlanes::kSlopes), i), 0xFFFFU);
    }
  }
}

/// Fails if far pixels are covered in part, or coverage falls when the line moves away.
TEST(HalfPlanes, CoverageGrowsWithTheDistance) {
  const HalfPlanes halfPlanes;
  for (std::int32_t slope = 0; slope < HalfPlanes::kSlopes; ++slope) {
    const HalfPlanes::Masks& masks = halfPlanes.at(slope);
    EXPECT_EQ(samplesOf(masks, 0), 0U);
    EXPECT_EQ(samplesOf(masks, HalfPlanes::kDistances - 1), 0xFFFFU);
    for (std::size_t i = 1; i < HalfPlanes::kDistances; ++i) {
      EXPECT_EQ(samplesOf(masks, i - 1) & ~samplesOf(masks, i), 0U);
    }
    const int before = std::popcount(samplesOf(masks, HalfPlanes::kDistances / 2 - 1));
    const int behind = std::popcount(samplesOf(masks, HalfPlanes::kDistances / 2));
    EXPECT_NEAR(0.5 * (before + behind), kPixelSamples / 2.0, 1.01) << slope;
  }
}

/// Fails if the slopes are mirrored: the normal points to where x grows, then down, then to where it falls.
TEST(HalfPlanes, NormalsPointToTheCoveredSide) {
  const HalfPlanes halfPlanes;
  constexpr std::size_t kMiddle = HalfPlanes::kDistances / 2;
  // Bit i is the sample of column i.
  EXPECT_GT(samplesOf(halfPlanes.at(HalfPlanes::kSlopes - 1), kMiddle), 0xFE00U);
  EXPECT_LT(samplesOf(halfPlanes.at(0), kMiddle), 0x0400U);
}

}  // namespace
}  // namespace grove::objects::lightfield
