#include "stream/adapt/border_choice.h"

#include <gtest/gtest.h>

namespace grove::stream {
namespace {

int percentAfter(BorderChoice& border, bool hasRoom, double roundTrip) {
  border.update(hasRoom, roundTrip);
  return border.percent();
}

// Faults: pixels that no page needs on a short line; none where turns need them.
TEST(BorderChoice, GrowsWithTheLine) {
  BorderChoice border;
  EXPECT_EQ(percentAfter(border, true, 0.010), 0);
  EXPECT_EQ(percentAfter(border, true, 0.070), 6);
  EXPECT_EQ(percentAfter(border, true, 0.150), BorderChoice::kMaxPercent);
  EXPECT_EQ(percentAfter(border, false, 0.150), 0);
}

// Fault: an independent picture each time that the round trip changes by a millisecond.
TEST(BorderChoice, KeepsItsSizeOnASteadyLine) {
  BorderChoice border;
  EXPECT_EQ(percentAfter(border, true, 0.066), 6);
  EXPECT_EQ(percentAfter(border, true, 0.064), 6);
  EXPECT_EQ(percentAfter(border, true, 0.050), 0);
}

}  // namespace
}  // namespace grove::stream
