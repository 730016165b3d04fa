#include "stream/adapt/stream_policy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace grove::stream {
namespace {

constexpr double kPeriod = 1.0 / 30.0;
const StreamWish kWish{1280, 720, 30.0};

StreamMeans line(double bitsPerSecond, double bitsPerPixel = 4.0) {
  return {.bitsPerSecond = bitsPerSecond, .bitsPerPixel = bitsPerPixel, .finest = 20.0, .coarsest = 40.0};
}

/// Lets a policy go on with the same means, and keeps what it decided each time it was another than before.
std::vector<StreamPlan> steps(StreamPolicy& policy, double from, double seconds, const StreamMeans& means,
                              const StreamWish& wish = kWish) {
  std::vector<StreamPlan> plans;
  for (double now = from; now < from + seconds; now += kPeriod) {
    const StreamPlan plan = policy.update(now, wish, means);
    if (plans.empty() || !(plan == plans.back())) plans.push_back(plan);
  }
  return plans;
}

// Faults: pictures that become smaller while a coarser quantiser would do; a limit that is told where there is none.
TEST(StreamPolicy, RaisesTheQuantiserFirst) {
  StreamPolicy policy;
  for (const double rate : {20e6, 6e6, 3e6, 2.2e6}) {
    const StreamPlan plan = steps(policy, 0.0, 5.0, line(rate)).back();
    EXPECT_EQ(plan, (StreamPlan{1280, 720, 30.0, LimitedBy::kNothing})) << rate;
  }
}

// Faults: frames that become fewer before pictures have become smaller; pictures that grow as the line gets worse.
TEST(StreamPolicy, ThenReducesSizeAndThenRate) {
  StreamPlan last{1280, 720, 30.0};
  double now = 0.0;
  StreamPolicy policy;
  std::vector<std::pair<int, double>> seen;
  for (double rate = 3e6; rate > 0.02e6; rate *= 0.8, now += 3.0) {
    const StreamPlan plan = steps(policy, now, 3.0, line(rate)).back();
    EXPECT_LE(plan.width, last.width) << rate;
    EXPECT_LE(plan.framesPerSecond, last.framesPerSecond) << rate;
    EXPECT_TRUE(plan.height <= 480 || plan.framesPerSecond == 30.0) << rate;
    EXPECT_EQ(plan.limitedBy, plan.height == 720 ? LimitedBy::kNothing : LimitedBy::kLine) << rate;
    last = plan;
  }
  EXPECT_LE(last.height, 180);
  EXPECT_LE(last.framesPerSecond, 5.0);
  EXPECT_GE(last.framesPerSecond, 1.0);
}

// Fault: a step at a time down to what a line that has broken down still carries.
TEST(StreamPolicy, ReactsFullyToStrongOverload) {
  StreamPolicy policy;
  (void)steps(policy, 0.0, 2.0, line(5e6));
  const auto plans = steps(policy, 2.0, 0.5, line(0.3e6));
  EXPECT_LE(plans.size(), 3U);
  EXPECT_LT(plans.back().height, 400);
}

// Fault: one dear picture, or one bad guess of the line's, that changes the size.
TEST(StreamPolicy, WaitsBeforeAChange) {
  StreamPolicy policy;
  (void)steps(policy, 0.0, 2.0, line(5e6));
  (void)policy.update(2.0, kWish, line(1.4e6));
  EXPECT_EQ(policy.update(2.03, kWish, line(1.4e6)).height, 720);
  EXPECT_EQ(steps(policy, 2.06, 2.0, line(5e6)).back().height, 720);
}

// Faults: no way back; all the way back at once, into the same trouble; a way back that begins at the first good sign.
TEST(StreamPolicy, RecoversStepwise) {
  StreamPolicy policy;
  (void)steps(policy, 0.0, 3.0, line(0.5e6));
  const StreamPlan low = policy.plan();
  ASSERT_LT(low.height, 600);
  EXPECT_EQ(steps(policy, 3.0, 1.5, line(6e6)).back(), low);
  const auto plans = steps(policy, 4.5, 30.0, line(6e6));
  EXPECT_EQ(plans.back(), (StreamPlan{1280, 720, 30.0, LimitedBy::kNothing}));
  EXPECT_GT(plans.size(), 3U);
}

// Fault: a size that is changed for ever, because what is sent at one step asks for the other.
TEST(StreamPolicy, DoesNotOscillate) {
  for (double rate = 0.1e6; rate < 4e6; rate *= 1.07) {
    StreamPolicy policy;
    (void)steps(policy, 0.0, 30.0, line(4e6));
    // What the line and the pictures are thought to be varies by a tenth.
    int changes = 0;
    StreamPlan last = steps(policy, 30.0, 20.0, line(rate)).back();
    for (double now = 50.0; now < 90.0; now += kPeriod) {
      const double wave = (static_cast<int>(now / 3.0) % 2 == 0) ? 1.1 : 0.9;
      const StreamPlan plan = policy.update(now, kWish, line(rate * wave));
      changes += plan == last ? 0 : 1;
      last = plan;
    }
    EXPECT_LE(changes, 2) << rate;
  }
}

// Fault: a picture that is made larger than the visitor's window, or keeps its size when he changes it.
TEST(StreamPolicy, RespectsVisitorLimits) {
  StreamPolicy policy;
  (void)steps(policy, 0.0, 3.0, line(0.8e6));
  const StreamWish small{640, 360, 15.0};
  const StreamPlan plan = steps(policy, 3.0, 20.0, line(6e6), small).back();
  EXPECT_EQ(plan, (StreamPlan{640, 360, 15.0, LimitedBy::kNothing}));
}

// Faults: odd sizes, which video codecs do not have; sizes beyond the bounds; windows out of shape.
TEST(FitSize, IsEvenAndWithinBounds) {
  for (std::uint32_t width = 1; width < 5000; width += 1 + width / 13) {
    for (std::uint32_t height = 1; height < 5000; height += 1 + height / 13) {
      const auto [w, h] = fitSize(width, height);
      ASSERT_TRUE(w % 2 == 0 && h % 2 == 0) << width << " x " << height;
      ASSERT_TRUE(w >= 160 && w <= 1920 && h >= 90 && h <= 1080) << width << " x " << height;
    }
  }
  EXPECT_EQ(fitSize(160, 90), std::pair(160, 90));
  EXPECT_EQ(fitSize(1920, 1080), std::pair(1920, 1080));
  EXPECT_EQ(fitSize(3840, 2160), std::pair(1920, 1080));
  EXPECT_EQ(fitSize(1281, 721), std::pair(1280, 720));
  EXPECT_EQ(fitSize(0, 0), fitSize(1, 1));
  EXPECT_EQ(fitSize(0xFFFFFFFFU, 0xFFFFFFFFU), std::pair(1080, 1080));
}

}  // namespace
}  // namespace grove::stream
