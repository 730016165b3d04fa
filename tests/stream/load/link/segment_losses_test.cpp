#include "stream/load/link/segment_losses.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace grove::stream {
namespace {

constexpr int kSegments = 1'000'000;

/// Fault: percent taken for shares, or retransmissions that are never lost.
TEST(SegmentLosses, AreAsFrequentAsTheyShall) {
  for (const double share : {0.001, 0.01, 0.03, 0.2}) {
    SegmentLosses losses(share, 7);
    std::array<int, SegmentLosses::kMaxTimes + 1> times{};
    for (int i = 0; i < kSegments; ++i) ++times.at(static_cast<std::size_t>(losses.next()));
    const double once = 1.0 - static_cast<double>(times[0]) / kSegments;
    EXPECT_NEAR(once, share, 5.0 * std::sqrt(share / kSegments));
    const double again = 1.0 - static_cast<double>(times[0] + times[1]) / kSegments;
    EXPECT_NEAR(again, share * share, 5.0 * std::sqrt(share * share / kSegments));
  }
}

/// Fault: losses of a run that cannot be repeated, or connections that all lose the same segments.
TEST(SegmentLosses, RepeatWithTheirSeed) {
  const auto drawn = [](std::uint64_t seed) {
    SegmentLosses losses(0.1, seed);
    std::vector<int> times;
    times.reserve(1000);
    for (int i = 0; i < 1000; ++i) times.push_back(losses.next());
    return times;
  };
  EXPECT_EQ(drawn(5), drawn(5));
  EXPECT_NE(drawn(5), drawn(6));
}

TEST(SegmentLosses, AreNoneOfNothing) {
  SegmentLosses losses(0.0, 1);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(losses.next(), 0);
}

}  // namespace
}  // namespace grove::stream
