#pragma once

#include <cstdint>
#include <vector>

#include "stream/load/link/congestion_window.h"
#include "stream/load/link/segment_losses.h"
#include "stream/load/link/tcp_recovery.h"

namespace grove::stream {

/// A TCP sender whose line loses segments: when its segments may leave, and when the lost ones arrive. Virtual time
/// only; times passed to it never decrease. Not thread-safe.
class LossySender {
 public:
  /// What a segment carries over Ethernet with TCP's time stamps.
  static constexpr std::size_t kSegmentBytes = 1448;

  /// `share` and `seed` as in SegmentLosses, the times as in TcpRecovery.
  LossySender(double share, std::uint64_t seed, LinkTime roundTrip, LinkTime jitter);

  /// Returns when the next segment may leave, from `time` on.
  [[nodiscard]] LinkTime mayLeave(LinkTime time);
  /// The next segment leaves; `arrives` if it is not lost. Returns the arrivals of lost segments, as
  /// TcpRecovery::sent(). Segments are numbered from 0.
  [[nodiscard]] const std::vector<TcpRecovery::Arrival>& sent(LinkTime leaves, LinkTime arrives);

  /// Bits per second that the window permits; infinity before the first loss.
  [[nodiscard]] double rateAt(LinkTime time) const;

 private:
  void advance(LinkTime time);

  LinkTime roundTrip_;
  SegmentLosses losses_;
  TcpRecovery recovery_;
  CongestionWindow window_;
  std::uint64_t next_ = 0;
};

}  // namespace grove::stream
