#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "stream/load/link/link_profile.h"

namespace grove::stream {

/// Computes when TCP closes the gaps that lost segments leave, as Linux does with selective acknowledgements, RACK and
/// tail loss probes. Virtual time only; times passed to it never decrease. Not thread-safe.
///
/// - Segments that were sent later arrive: their acknowledgements reveal the loss, the third one's at once, an earlier
///   one's when a quarter of the round trip has passed for reordering (RFC 8985, 6.2). This holds for retransmissions,
///   too, but without a wait. So a segment in a dense stream is late by one round trip.
/// - No later segment arrives: a probe is sent two round trips (at least 10 ms) after the last segment, or after the
///   last acknowledgement if that comes later. With a single segment in flight, 200 ms are added for an acknowledgement
///   that is held back. The probe is not later than the time-out would be (RFC 8985, 7.2), and only repairs the last
///   segment; its acknowledgement reveals the others.
/// - A retransmission is lost, and nothing later arrives: the time-out, SRTT + max(200 ms, 4 RTTVAR), which doubles
/// each
///   time (RFC 6298 with Linux's minimum).
///
/// Left out: round trips that grow with the queue, lost acknowledgements (later ones replace them), and that Linux,
/// while it repairs one loss, waits for the time-out instead of sending probes.
class TcpRecovery {
 public:
  struct Segment {
    std::uint64_t number = 0;
    LinkTime leaves{0};
    LinkTime arrives{0};  ///< if it is not lost
    int timesLost = 0;    ///< before it gets through
  };
  struct Arrival {
    std::uint64_t number = 0;
    LinkTime arrives{0};
  };
  /// Gets when a lost segment had left first, and when the sender noticed that it is lost.
  using Noticed = std::function<void(LinkTime left, LinkTime noticed)>;

  /// `roundTrip` is of the idle line; `jitter` as in LinkProfile.
  TcpRecovery(LinkTime roundTrip, LinkTime jitter);

  /// The sender's time is now `now`: reports the losses that it has noticed.
  void advance(LinkTime now, const Noticed& noticed);

  /// A segment is sent, after advance() to the time at which it leaves. Returns the arrivals of lost segments that this
  /// determines anew, its own among them; what the future sends may bring them forward. Valid until the next call.
  [[nodiscard]] const std::vector<Arrival>& sent(const Segment& segment);

 private:
  /// A segment whose latest transmission is lost.
  struct Gap {
    Segment segment;
    LinkTime sent;     ///< its latest transmission
    LinkTime resends;  ///< when the sender transmits it again, as far as is known
    LinkTime timeout;
    int moreLost;  ///< transmissions after the latest one that are lost, too
    bool isRepeated = false;
    int later = 0;  ///< segments sent after that transmission that arrived
  };

  void openGap(const Segment& segment);
  /// Returns whether its arrival has changed.
  bool follow(Gap& gap, const Segment& later) const;
  static void resend(Gap& gap);
  /// If nothing more is sent.
  [[nodiscard]] static LinkTime arrivalOf(Gap gap);

  LinkTime reordering_;
  LinkTime roundTrip_;  ///< smoothed
  LinkTime probe_;
  LinkTime timeout_;
  LinkTime lastAcknowledged_{0};
  std::vector<Gap> gaps_;
  std::vector<Arrival> changed_;
};

}  // namespace grove::stream
