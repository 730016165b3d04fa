#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "stream/load/link/lossy_sender.h"

// What losses cost a stream of frames in one TCP connection, and what they would cost it if each frame had a stream of
// its own, as over WebTransport: the same losses and the same repairs, but a repair delays only its own frame.
// server/stream/README.md shows the figures. The congestion window, which both would share, is left out.
namespace grove::stream {
namespace {

using namespace std::chrono_literals;

constexpr int kFrames = 30 * 600;
constexpr int kFrameSegments = 14;  // 5 Mbit/s at 30 frames per second
constexpr LinkTime kPeriod = LinkTime(1s) / 30;
constexpr double kLineRate = 20e6;
constexpr std::array kLosses = {0.001, 0.01, 0.03};
constexpr std::array<LinkTime, 2> kRoundTrips = {30ms, 80ms};

/// Latencies of frames from when they are sent until they are complete, in ms.
struct Latencies {
  std::vector<double> inOrder;  ///< each frame behind all before it
  std::vector<double> alone;
};

double milliseconds(LinkTime time) { return std::chrono::duration<double, std::milli>(time).count(); }

double quantile(std::vector<double> all, double q) {
  const auto at = all.begin() + std::llround(q * static_cast<double>(all.size() - 1));
  std::ranges::nth_element(all, at);
  return *at;
}

Latencies latencies(double loss, LinkTime roundTrip) {
  SegmentLosses losses(loss, 1);
  TcpRecovery recovery(roundTrip, 0ms);
  const auto transmission = LinkTime{std::llround(8e9 * LossySender::kSegmentBytes / kLineRate)};
  std::vector<LinkTime> arrivals;
  LinkTime leaves = 0ns;
  for (int frame = 0; frame < kFrames; ++frame) {
    for (int segment = 0; segment < kFrameSegments; ++segment) {
      leaves = std::max(leaves, frame * kPeriod) + transmission;
      const std::uint64_t sent = arrivals.size();
      arrivals.push_back(leaves + roundTrip / 2);
      recovery.advance(leaves, [](LinkTime, LinkTime) {});
      for (const auto& [number, arrives] : recovery.sent({sent, leaves, arrivals.back(), losses.next()})) {
        arrivals[number] = arrives;
      }
    }
  }
  Latencies result;
  LinkTime before = 0ns;
  for (int frame = 0; frame < kFrames; ++frame) {
    const auto first = arrivals.begin() + static_cast<std::ptrdiff_t>(frame) * kFrameSegments;
    const LinkTime alone = *std::max_element(first, first + kFrameSegments);
    before = std::max(before, alone);
    result.inOrder.push_back(milliseconds(before - frame * kPeriod));
    result.alone.push_back(milliseconds(alone - frame * kPeriod));
  }
  return result;
}

/// Share of frames that are more than a frame's period later than without losses.
double lateShare(const std::vector<double>& all) {
  const double limit = *std::ranges::min_element(all) + milliseconds(kPeriod);
  return static_cast<double>(std::ranges::count_if(all, [&](double ms) { return ms > limit; })) /
         static_cast<double>(all.size());
}

/// Fault: figures in the documents that nobody can compute again; a repair that delays frames before it, or a frame in
/// a stream of its own that waits for another one's.
TEST(FramesInStreams, LossesDelayTheirOwnFrameOnly) {
  for (const LinkTime roundTrip : kRoundTrips) {
    for (const double loss : kLosses) {
      const Latencies all = latencies(loss, roundTrip);
      std::printf(
          "%.0f ms, %.1f %%: in order, alone: p50 %.0f, %.0f; p95 %.0f, %.0f; p99 %.0f, %.0f; late %.1f, %.1f %%\n",
          milliseconds(roundTrip), 100.0 * loss, quantile(all.inOrder, 0.5), quantile(all.alone, 0.5),
          quantile(all.inOrder, 0.95), quantile(all.alone, 0.95), quantile(all.inOrder, 0.99),
          quantile(all.alone, 0.99), 100.0 * lateShare(all.inOrder), 100.0 * lateShare(all.alone));
      EXPECT_LE(lateShare(all.alone), lateShare(all.inOrder));
      for (int frame = 0; frame < kFrames; ++frame) {
        const auto at = static_cast<std::size_t>(frame);
        ASSERT_LE(all.alone[at], all.inOrder[at]) << frame;
      }
    }
  }
  const Latencies far = latencies(0.01, 80ms);
  EXPECT_NEAR(lateShare(far.inOrder), 0.25, 0.02);
  EXPECT_NEAR(lateShare(far.alone), 0.13, 0.02) << "of a frame's 14 segments, one is lost in 13 % of the frames";
}

}  // namespace
}  // namespace grove::stream
