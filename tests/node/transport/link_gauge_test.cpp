#include "node/transport/link_gauge.h"

#include <gtest/gtest.h>

namespace grove::node {
namespace {

using namespace std::chrono_literals;

class LinkGaugeTest : public ::testing::Test {
 protected:
  /// Once a second, when so much has travelled altogether.
  void readAt(int second, std::uint64_t sent, std::uint64_t received, LinkGauge::Clock::duration roundTrip = 2ms) {
    const LinkTraffic traffic{.toBackend = sent, .pictures = received / 2, .sharedData = 0, .headers = received / 2};
    gauge.read(LinkGauge::Clock::time_point(std::chrono::seconds(second)), traffic, roundTrip);
  }
  LinkGauge gauge;
};

TEST_F(LinkGaugeTest, NeedsTwoReadingsForRates) {
  EXPECT_FALSE(gauge.pace().roundTrip);
  readAt(10, 5000, 9000);
  EXPECT_DOUBLE_EQ(gauge.pace().roundTrip.value_or(0.0), 0.002);
  EXPECT_EQ(gauge.pace().sent, 0.0) << "what has travelled before was not in this second";
  EXPECT_EQ(gauge.pace().received, 0.0);
}

TEST_F(LinkGaugeTest, RatesAreOfTheLastFiveSeconds) {
  for (int second = 0; second <= 20; ++second) {
    const std::uint64_t fast = 1000 * static_cast<std::uint64_t>(second);
    const std::uint64_t slow = second <= 10 ? 10 * fast : 100'000 + 4 * (fast - 10'000);
    readAt(second, fast, slow);
  }
  EXPECT_DOUBLE_EQ(gauge.pace().sent, 1000.0);
  EXPECT_DOUBLE_EQ(gauge.pace().received, 4000.0) << "not the ten thousand of the seconds before";
}

TEST_F(LinkGaugeTest, LateReadingsDoNotRaiseRates) {
  readAt(0, 0, 0);
  readAt(1, 100, 0);
  readAt(4, 400, 0);
  EXPECT_DOUBLE_EQ(gauge.pace().sent, 100.0);
}

/// Or one answer that waited for a busy processor would show as a slow network.
TEST_F(LinkGaugeTest, RoundTripIsTheRecentMinimum) {
  readAt(0, 0, 0, 1ms);
  for (int second = 1; second <= 5; ++second) readAt(second, 0, 0, second == 3 ? 20ms : 90ms);
  EXPECT_DOUBLE_EQ(gauge.pace().roundTrip.value_or(0.0), 0.001);
  readAt(6, 0, 0, 90ms);
  EXPECT_DOUBLE_EQ(gauge.pace().roundTrip.value_or(0.0), 0.020) << "the first one is too old";
}

TEST_F(LinkGaugeTest, ForgetsClosedLinks) {
  readAt(0, 0, 0);
  readAt(1, 1000, 1000);
  gauge.clear();
  EXPECT_FALSE(gauge.pace().roundTrip);
  EXPECT_EQ(gauge.pace().sent, 0.0);
}

}  // namespace
}  // namespace grove::node
