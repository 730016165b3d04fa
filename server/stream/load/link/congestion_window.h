#pragma once

#include <deque>
#include <limits>

#include "stream/load/link/link_profile.h"

namespace grove::stream {

/// Bounds the segments in flight as CUBIC (RFC 9438) does after losses: a loss reduces the window to 0.7 of it, and it
/// grows back by the cube of time, or as Reno's would if that is faster, as it is at short round trips. Several losses
/// of one flight count once. Virtual time only; times passed to it never decrease. Not thread-safe.
///
/// Before the first loss nothing is bounded; that loss finds as many segments as were ever in flight. The window then
/// also grows while it is not used up, which Linux's does not, and a time-out reduces it as a loss does, without the
/// slow start from one segment: both are kinder than Linux.
class CongestionWindow {
 public:
  explicit CongestionWindow(LinkTime roundTrip);

  /// Returns `time` if another segment may leave then, else when the next acknowledgement comes.
  [[nodiscard]] LinkTime opens(LinkTime time);
  void sent(LinkTime leaves);
  /// The sender notices that a segment is lost which had left at `left`.
  void lost(LinkTime left, LinkTime noticed);

  /// Returns how many segments may be in flight; infinity before the first loss.
  [[nodiscard]] double segments(LinkTime time) const;

 private:
  void acknowledge(LinkTime time);

  LinkTime roundTrip_;
  std::deque<LinkTime> inFlight_;
  std::size_t mostInFlight_;
  double atLoss_ = std::numeric_limits<double>::infinity();
  LinkTime reduced_{-1};
};

}  // namespace grove::stream
