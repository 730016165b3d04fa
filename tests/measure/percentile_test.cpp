#include "measure/percentile.h"

#include <gtest/gtest.h>

namespace grove::measure {
namespace {

TEST(Percentile, IsTheNearestRank) {
  EXPECT_EQ(percentile(std::vector<double>(), 0.5), 0.0);
  EXPECT_EQ(percentile(std::vector{3.0}, 0.99), 3.0);
  const std::vector<float> four{4.0F, 1.0F, 3.0F, 2.0F};
  EXPECT_EQ(percentile(four, 0.0), 1.0);
  EXPECT_EQ(percentile(four, 0.5), 2.0);
  EXPECT_EQ(percentile(four, 0.51), 3.0);
  EXPECT_EQ(percentile(four, 0.99), 4.0);
}

}  // namespace
}  // namespace grove::measure
