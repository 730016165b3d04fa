#include "stream/adapt/frame_times.h"

#include <gtest/gtest.h>

namespace grove::stream {
namespace {

// Faults: a mean that one outlier spoils; times of a second before; a report when nothing was sent.
TEST(FrameTimes, ReportsMediansOncePerSecond) {
  FrameTimes times;
  for (const double seconds : {0.002, 0.003, 0.900}) times.add(FrameTimes::Place::kEncoder, seconds);
  for (const double seconds : {0.010, 0.012, 0.011}) times.add(FrameTimes::Place::kLine, seconds);
  const auto first = times.take(10.0);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->encodedTenthsOfMilliseconds, 30);
  EXPECT_EQ(first->lineTenthsOfMilliseconds, 110);
  EXPECT_EQ(first->queuedTenthsOfMilliseconds, 0);
  times.add(FrameTimes::Place::kEncoder, 0.005);
  EXPECT_FALSE(times.take(10.5));
  EXPECT_EQ(times.take(11.0)->encodedTenthsOfMilliseconds, 50);
  EXPECT_FALSE(times.take(12.0));
}

// Fault: a time that does not fit its field and comes out small.
TEST(FrameTimes, Saturates) {
  FrameTimes times;
  times.add(FrameTimes::Place::kEncoder, 60.0);
  EXPECT_EQ(times.take(10.0)->encodedTenthsOfMilliseconds, 0xFFFF);
}

}  // namespace
}  // namespace grove::stream
