#include "measure/pictures/quality_policy.h"

#include <gtest/gtest.h>

namespace grove::measure {
namespace {

/// A second's measurements, fed one after the other.
class QualityPolicies : public ::testing::Test {
 protected:
  int after(int seconds, const QualityLoad& load) {
    for (int i = 0; i < seconds; ++i) policy.update(now += 1.0, load);
    return policy.step();
  }
  QualityPolicy policy;
  double now = 1000.0;
};

constexpr QualityLoad kRoom{.visitors = 4, .cores = 8, .busyCores = 1.0, .acrossUserCores = 0.15};

TEST_F(QualityPolicies, RisesWithVisitors) {
  EXPECT_EQ(after(5, kRoom), 0) << "room must last";
  EXPECT_EQ(after(10, kRoom), 1);
}

TEST_F(QualityPolicies, DoesNotRiseWithoutSavings) {
  QualityLoad few = kRoom;
  few.visitors = 3;  // step 1 costs 3.375 times as much
  EXPECT_EQ(after(100, few), 0);
  EXPECT_EQ(after(100, kRoom), 1) << "four save enough for one step, not for two";
  QualityLoad many = kRoom;
  many.visitors = 12;
  EXPECT_EQ(after(100, many), 2);
  EXPECT_EQ(after(100, many), 2) << "there is no step 3";
}

TEST_F(QualityPolicies, DoesNotRiseOnABusyMachine) {
  QualityLoad busy = kRoom;
  busy.busyCores = 5.8;  // 0.36 more would pass three quarters of eight
  EXPECT_EQ(after(100, busy), 0);
}

TEST_F(QualityPolicies, FallsImmediatelyAndRisesLate) {
  ASSERT_EQ(after(30, kRoom), 1);
  QualityLoad slow = kRoom;
  slow.frameShare = 0.7;
  EXPECT_EQ(after(1, slow), 0);
  EXPECT_EQ(after(40, kRoom), 0) << "it has just been too much";
  EXPECT_EQ(after(30, kRoom), 1);
}

TEST_F(QualityPolicies, FallsStepwiseAsVisitorsLeave) {
  QualityLoad many = kRoom;
  many.visitors = 12;
  ASSERT_EQ(after(100, many), 2);
  QualityLoad few = kRoom;
  few.visitors = 6;
  EXPECT_EQ(after(1, few), 1);
  EXPECT_EQ(after(50, few), 1) << "six pay for one step, not for two";
  few.visitors = 1;
  EXPECT_EQ(after(1, few), 0);
}

TEST_F(QualityPolicies, DoesNotOscillateBetweenBounds) {
  ASSERT_EQ(after(30, kRoom), 1);
  QualityLoad between = kRoom;
  between.busyCores = 7.0;
  int changes = 0;
  int last = policy.step();
  for (int i = 0; i < 600; ++i) {
    const int step = after(1, between);
    changes += step == last ? 0 : 1;
    last = step;
  }
  EXPECT_EQ(changes, 0);
}

TEST_F(QualityPolicies, WaitsForTheEffectOfAChange) {
  ASSERT_EQ(after(10, kRoom), 1);
  QualityLoad peak = kRoom;
  peak.busyCores = 7.9;  // of the change itself
  EXPECT_EQ(after(1, peak), 1);
}

}  // namespace
}  // namespace grove::measure
