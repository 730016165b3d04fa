#include "objects/fluid/backend/pace.h"

#include <gtest/gtest.h>

namespace grove::objects::fluid {
namespace {

int slowAmong(Pace& pace, int ticks, double seconds) {
  int slow = 0;
  for (int i = 0; i < ticks; ++i) slow += pace.slowMean(seconds) ? 1 : 0;
  return slow;
}

TEST(PaceTest, OnlyTheMeanOfManyTicksCounts) {
  Pace pace(0.03);
  EXPECT_EQ(slowAmong(pace, 10 * Pace::kTicks, 0.028), 0);
  EXPECT_FALSE(pace.slowMean(0.05));
  EXPECT_EQ(slowAmong(pace, Pace::kTicks - 1, 0.025), 0) << "one may take long";
  EXPECT_EQ(slowAmong(pace, Pace::kTicks - 1, 0.08), 0) << "not judged before its time";
  EXPECT_TRUE(pace.slowMean(0.08));
}

// Fault: the last tick's time is reported, which may be far from the mean that is too long.
TEST(PaceTest, TellsTheMean) {
  Pace pace(0.03);
  EXPECT_EQ(slowAmong(pace, Pace::kTicks - 1, 0.04), 0);
  EXPECT_NEAR(pace.slowMean(0.01).value_or(0.0), 0.039, 1.0e-9);
}

TEST(PaceTest, ResetsForOtherTicks) {
  Pace pace(0.03);
  EXPECT_EQ(slowAmong(pace, Pace::kTicks - 1, 0.08), 0);
  pace.restart();
  EXPECT_EQ(slowAmong(pace, Pace::kTicks, 0.02), 0);
  EXPECT_EQ(slowAmong(pace, Pace::kTicks, 0.08), 1);
}

}  // namespace
}  // namespace grove::objects::fluid
