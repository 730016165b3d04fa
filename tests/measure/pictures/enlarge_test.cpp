#include "measure/pictures/enlarge.h"

#include <gtest/gtest.h>

namespace grove::measure {
namespace {

// Faults: a picture that is shifted by half a pixel; channels that run into each other.
TEST(Enlarge, InterpolatesBetweenTheMiddlesOfTexels) {
  const std::vector<std::uint32_t> two{0xFF0000C8U, 0xFF640000U};
  const std::vector<std::uint32_t> four = enlarged({two, 2}, 4, 2);
  ASSERT_EQ(four.size(), 8U);
  EXPECT_EQ(four[0], 0xFF0000C8U) << "beyond the first middle";
  EXPECT_EQ(four[1], 0xFF190096U) << "a quarter of the way";
  EXPECT_EQ(four[2], 0xFF4B0032U);
  EXPECT_EQ(four[3], 0xFF640000U);
  EXPECT_EQ(four[5], four[1]) << "rows alike";
}

// Fault: a picture of the same size changes.
TEST(Enlarge, KeepsASize) {
  const std::vector<std::uint32_t> picture{1, 2, 3, 4, 5, 6};
  EXPECT_EQ(enlarged({picture, 3}, 3, 2), picture);
}

}  // namespace
}  // namespace grove::measure
