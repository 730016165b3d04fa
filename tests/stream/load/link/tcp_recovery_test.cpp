#include "stream/load/link/tcp_recovery.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>

namespace grove::stream {
namespace {

using namespace std::chrono_literals;

/// A sender over a round trip of 80 ms. Each test gives the arithmetic of its arrivals: 40 ms there, 40 ms back.
class TcpRecoveryTest : public testing::Test {
 protected:
  void send(LinkTime leaves, int timesLost = 0) {
    recovery_.advance(leaves, [this](LinkTime left, LinkTime noticed) { noticed_.emplace_back(left, noticed); });
    for (const auto& [number, arrives] : recovery_.sent({next_, leaves, leaves + 40ms, timesLost})) {
      arrivals_[number] = arrives;
    }
    ++next_;
  }

  TcpRecovery recovery_{80ms, 0ms};
  std::uint64_t next_ = 0;
  std::map<std::uint64_t, LinkTime> arrivals_;  ///< of lost segments
  std::vector<std::pair<LinkTime, LinkTime>> noticed_;
};

/// Fault: a wait for the reordering window, or for a time-out, where three acknowledgements suffice.
TEST_F(TcpRecoveryTest, ThirdLaterSegmentRevealsALoss) {
  send(0ms);
  send(1ms, 1);
  for (const LinkTime leaves : {2ms, 3ms, 4ms, 5ms}) send(leaves);
  EXPECT_EQ(arrivals_.at(1), 4ms + 40ms + 40ms + 40ms) << "the third arrives, is acknowledged, and the repair arrives";
  EXPECT_EQ(arrivals_.size(), 1U) << "only the lost one";
}

/// Fault: a stream of single segments that waits for three of them: at 30 a second, 100 ms more.
TEST_F(TcpRecoveryTest, OneLaterSegmentRevealsALossAfterTheReorderingWindow) {
  send(0ms, 1);
  send(5ms);
  EXPECT_EQ(arrivals_.at(0), 80ms + 20ms + 40ms) << "a quarter of the round trip for reordering";
  send(6ms);
  EXPECT_EQ(arrivals_.at(0), 140ms);
  send(7ms);
  EXPECT_EQ(arrivals_.at(0), 7ms + 120ms) << "the third ends the wait";

  send(1000ms, 1);
  send(1033ms);
  EXPECT_EQ(arrivals_.at(4), 1033ms + 120ms) << "the window is over when it arrives";
}

/// Fault: a probe without the 200 ms of an acknowledgement that is held back, or later than the time-out.
TEST_F(TcpRecoveryTest, LoneLastSegmentWaitsForTheTimeout) {
  send(0ms);
  send(1000ms, 1);
  EXPECT_EQ(arrivals_.at(1), 1000ms + (80ms + 200ms) + 40ms);
  send(2000ms);
  send(2001ms, 1);
  EXPECT_EQ(arrivals_.at(3), 2080ms + 280ms + 40ms) << "the acknowledgement of the one before it restarts the timer";
}

/// Fault: a tail of several segments that waits for the time-out, 120 ms later.
TEST_F(TcpRecoveryTest, ProbeRevealsALostTail) {
  send(0ms, 1);
  send(1ms, 1);
  EXPECT_EQ(arrivals_.at(1), 1ms + 160ms + 40ms) << "the probe repairs the last one";
  EXPECT_EQ(arrivals_.at(0), 1ms + 160ms + 80ms + 40ms) << "and its acknowledgement reveals the other";
}

/// Fault: a segment that comes after the probe, and delays or hastens what the probe has repaired.
TEST_F(TcpRecoveryTest, SegmentsAfterARepairChangeNothing) {
  send(0ms, 1);
  const LinkTime alone = arrivals_.at(0);
  for (const LinkTime leaves : {281ms, 282ms, 283ms}) send(leaves);
  EXPECT_EQ(arrivals_.at(0), alone);
  EXPECT_EQ(alone, 320ms);
}

/// Fault: a time-out for each lost retransmission in a dense stream, where RACK needs a round trip.
TEST_F(TcpRecoveryTest, LaterSegmentsRevealALostRetransmission) {
  send(0ms, 2);
  for (LinkTime leaves = 1ms; leaves < 400ms; leaves += 1ms) send(leaves);
  // Resent at 3 + 80 = 83 ms; what leaves right behind it is acknowledged at 163 ms, without a reordering window.
  EXPECT_EQ(arrivals_.at(0), 163ms + 40ms);
}

/// Fault: time-outs that do not double, or are counted from the first transmission.
TEST_F(TcpRecoveryTest, TimeoutsDouble) {
  send(0ms, 4);
  EXPECT_EQ(arrivals_.at(0), 280ms + 280ms + 560ms + 1120ms + 40ms);
  send(300ms, 0);  // between the first and the second time-out
  EXPECT_EQ(arrivals_.at(0), 380ms + 280ms + 560ms + 40ms) << "a repair that RACK began does not double it";
}

/// Fault: a congestion window that hears of a loss before the sender can know it, or never.
TEST_F(TcpRecoveryTest, TellsWhenTheSenderNotices) {
  send(0ms, 2);
  for (LinkTime leaves = 1ms; leaves <= 200ms; leaves += 1ms) send(leaves);
  using Notice = std::pair<LinkTime, LinkTime>;
  EXPECT_EQ(noticed_, (std::vector<Notice>{{0ms, 83ms}, {0ms, 163ms}}));
}

/// Fault: a line with jitter whose time-out ends before late acknowledgements come.
TEST(TcpRecovery, TimeoutGrowsWithTheJitter) {
  TcpRecovery recovery(80ms, 300ms);
  const auto& changed = recovery.sent({0, 0ms, 40ms, 1});
  ASSERT_EQ(changed.size(), 1U);
  EXPECT_EQ(changed.front().arrives, 80ms + 300ms + 400ms + 40ms) << "SRTT + 4 RTTVAR";
}

}  // namespace
}  // namespace grove::stream
