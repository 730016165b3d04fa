#include "stream/load/link/congestion_window.h"

#include <gtest/gtest.h>

#include <cmath>

namespace grove::stream {
namespace {

using namespace std::chrono_literals;

/// Fault: a line without losses that is slower than its profile.
TEST(CongestionWindow, BoundsNothingBeforeTheFirstLoss) {
  CongestionWindow window(80ms);
  for (int i = 0; i < 10'000; ++i) {
    EXPECT_EQ(window.opens(1ms), 1ms);
    window.sent(1ms);
  }
}

/// Fault: a window that is halved as Reno's, or that never returns to what it was.
TEST(CongestionWindow, FallsToSevenTenthsAndGrowsBack) {
  CongestionWindow window(80ms);
  for (int i = 0; i < 100; ++i) window.sent(0ms);
  window.lost(0ms, 100ms);
  EXPECT_NEAR(window.segments(100ms), 70.0, 1e-9);
  const double back = std::cbrt(100.0 * 0.3 / 0.4);  // RFC 9438, figure 2
  EXPECT_NEAR(window.segments(100ms + LinkTime{std::llround(back * 1e9)}), 100.0, 1e-3);
  EXPECT_GT(window.segments(10s), 150.0);
  EXPECT_LT(window.segments(1s), 100.0);
}

/// Fault: ten losses of one flight that count as ten.
TEST(CongestionWindow, LossesOfOneFlightCountOnce) {
  CongestionWindow window(80ms);
  for (int i = 0; i < 100; ++i) window.sent(0ms);
  window.lost(0ms, 100ms);
  window.lost(50ms, 130ms);
  EXPECT_NEAR(window.segments(100ms), 70.0, 1e-9);
  window.lost(101ms, 181ms);
  EXPECT_LT(window.segments(181ms), 55.0);
}

/// Fault: a sender that waits for less, or more, than the first acknowledgement; a small flight that closes the window.
TEST(CongestionWindow, OpensWithTheNextAcknowledgement) {
  CongestionWindow window(80ms);
  window.lost(0ms, 0ms);  // of the ten initial segments
  for (const LinkTime leaves : {10ms, 20ms, 30ms, 40ms, 50ms, 60ms, 70ms}) {
    EXPECT_EQ(window.opens(leaves), leaves);
    window.sent(leaves);
  }
  EXPECT_EQ(window.opens(75ms), 90ms);
  EXPECT_EQ(window.opens(90ms), 90ms);
}

/// Fault: a window of CUBIC's alone, which at short round trips is a twentieth of Reno's. Reno's is 1.22 / sqrt(p) on
/// average (Mathis et al., The macroscopic behavior of the TCP congestion avoidance algorithm, 1997), and RFC 9438's
/// growth keeps it.
TEST(CongestionWindow, IsAsLargeAsRenosAtShortRoundTrips) {
  CongestionWindow window(5ms);
  for (int i = 0; i < 20; ++i) window.sent(0ms);
  window.lost(0ms, 0ms);
  double sum = 0.0;
  double sinceLoss = 0.0;
  int trips = 0;
  for (LinkTime time = 0ns; trips < 20'000; ++trips, time += 5ms) {
    sum += window.segments(time);
    sinceLoss += window.segments(time);
    if (sinceLoss < 100.0) continue;
    sinceLoss -= 100.0;
    window.lost(time, time + 5ms);
  }
  EXPECT_NEAR(sum / trips, 12.2, 1.0);
}

}  // namespace
}  // namespace grove::stream
