#include <gtest/gtest.h>

#include "stream/load/link/counting_bytes.h"
#include "stream/load/link/link_line.h"

namespace grove::stream {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kSegment = LossySender::kSegmentBytes;

LinkLine lossyLine(double loss, std::uint64_t seed, double rate = 100e6) {
  return {LinkSchedule({{0ns, rate}}, 0ns, 0ns), 40ms, 0ns, seed, loss};
}

constexpr LinkTime kSegmentPeriod = 20ms;  // four segments a round trip, which the congestion window lets through

/// Puts a segment in every kSegmentPeriod, and returns each one's delay.
std::vector<LinkTime> delays(LinkLine line, int segments) {
  std::vector<LinkTime> result;
  std::size_t put = 0;
  std::size_t got = 0;
  for (LinkTime now = 0ns; static_cast<int>(result.size()) < segments && now < 1h; now += 100us) {
    if (now == kSegmentPeriod * static_cast<int>(put / kSegment) &&
        put < static_cast<std::size_t>(segments) * kSegment) {
      EXPECT_GE(line.room(now), kSegment);
      line.put(counting(kSegment, put), now);
      put += kSegment;
    }
    for (auto bytes = line.arrived(now); !bytes.empty(); bytes = line.arrived(now)) {
      const std::vector<std::uint8_t> piece(bytes.begin(), bytes.end());
      EXPECT_EQ(piece, counting(piece.size(), got));
      got += piece.size();
      line.fetched(piece.size());
      result.push_back(now - kSegmentPeriod * static_cast<int>(result.size()));
    }
  }
  return result;
}

/// Fault: a segment that passes a lost one; bytes that are missing, twice there or out of order.
TEST(LossyLine, HoldsBackWhatIsBehindALoss) {
  const std::vector<LinkTime> all = delays(lossyLine(0.01, 3), 5000);
  ASSERT_EQ(all.size(), 5000U);
  int late = 0;
  for (std::size_t i = 1; i < all.size(); ++i) {
    EXPECT_GE(all[i], 40ms);
    EXPECT_GE(all[i] + kSegmentPeriod, all[i - 1]) << "segments arrive in order";
    if (all[i] > 45ms && all[i - 1] <= 45ms) ++late;
  }
  // Of about 50 losses, those of the next 100 ms are hidden by one before them.
  EXPECT_GE(late, 30);
  EXPECT_LE(late, 65);
}

/// Fault: what waits behind a gap, and then arrives one after the other instead of at once.
TEST(LossyLine, DeliversAllAtOnceWhenAGapIsClosed) {
  const std::vector<LinkTime> all = delays(lossyLine(0.002, 3), 5000);
  int bursts = 0;
  for (std::size_t i = 1; i + 5 < all.size(); ++i) {
    if (all[i] <= 45ms || all[i - 1] > 45ms) continue;
    ++bursts;
    for (std::size_t behind = 1; behind < 5; ++behind) {
      EXPECT_EQ(all[i + behind], all[i] - kSegmentPeriod * static_cast<int>(behind)) << "they arrive at the same time";
    }
    EXPECT_NEAR(static_cast<double>(all[i].count()) * 1e-6, 40.0 + 20.0 + 80.0, 1.0)
        << "one later segment reveals the loss, after the wait for reordering";
  }
  EXPECT_GE(bursts, 4);
}

/// Fault: a seed that does not repeat its stalls, or two connections with the same ones.
TEST(LossyLine, RepeatsItsStallsWithItsSeed) {
  EXPECT_EQ(delays(lossyLine(0.02, 5), 1000), delays(lossyLine(0.02, 5), 1000));
  EXPECT_NE(delays(lossyLine(0.02, 5), 1000), delays(lossyLine(0.02, 6), 1000));
}

/// Fault: a sender that goes on at the line's rate although it loses segments, or one that losses slow down for good.
/// Mathis et al., The macroscopic behavior of the TCP congestion avoidance algorithm (1997): 1.22 / sqrt(p) segments
/// a round trip, here 12.2.
TEST(LossyLine, LossesBoundTheRate) {
  LinkLine line = lossyLine(0.01, 1);
  std::size_t arrived = 0;
  constexpr LinkTime kUntil = 200s;
  for (LinkTime now = 0ns; now < kUntil; now += 1ms) {
    if (const std::size_t room = line.room(now); room > 0) line.put(counting(room), now);
    for (auto bytes = line.arrived(now); !bytes.empty(); bytes = line.arrived(now)) {
      arrived += bytes.size();
      line.fetched(bytes.size());
    }
  }
  const double segments = static_cast<double>(arrived) / kSegment / (kUntil / 80ms);
  EXPECT_NEAR(segments, 12.2, 4.0) << "several losses of one flight count once";
}

/// Fault: a line that ends although a segment is still being repaired.
TEST(LossyLine, EndsBehindARepair) {
  LinkLine line = lossyLine(0.2, 1);
  line.put(counting(100 * kSegment), 0ns);
  line.end(1ms);
  LinkTime now = 0ns;
  std::size_t got = 0;
  for (; !line.isOver(now) && now < 100s; now += 1ms) {
    for (auto bytes = line.arrived(now); !bytes.empty(); bytes = line.arrived(now)) {
      got += bytes.size();
      line.fetched(bytes.size());
    }
  }
  EXPECT_EQ(got, 100 * kSegment);
  EXPECT_LT(now, 100s);
  EXPECT_GT(now, 150ms) << "of a hundred segments at 20 %, some are lost";
}

}  // namespace
}  // namespace grove::stream
