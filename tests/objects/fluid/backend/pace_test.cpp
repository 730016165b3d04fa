#include "objects/fluid/backend/pace.h"

#include <gtest/gtest.h>

namespace grove::objects::fluid {
namespace {

int slowAmong(Pace& pace, int ticks, double seconds) {
  int slow = 0;
  for (int i = 0; i < ticks; ++i) slow += pace.tooSlow(seconds) ? 1 : 0;
  return slow;
}

TEST(PaceTest, OnlyTheMeanOfManyTicksCounts) {
  Pace pace(0.03);
  EXPECT_EQ(slowAmong(pace, 10 * Pace::kTicks, 0.028), 0);
  EXPECT_FALSE(pace.tooSlow(0.05));
  EXPECT_EQ(slowAmong(pace, Pace::kTicks - 1, 0.025), 0) << "one may take long";
  EXPECT_EQ(slowAmong(pace, Pace::kTicks - 1, 0.08), 0) << "not judged before its time";
  EXPECT_TRUE(pace.tooSlow(0.08));
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
