#pragma once

#include <chrono>
#include <cstddef>
#include <deque>

#include "node/transport/transport.h"

namespace grove::node {

/// Measures the pace of a link from one reading per second. One thread at a time.
class LinkGauge {
 public:
  using Clock = std::chrono::steady_clock;

  /// Adds a reading: the traffic so far and the newest round trip.
  void read(Clock::time_point now, const LinkTraffic& traffic, Clock::duration roundTrip);
  /// The link is closed.
  void clear() { readings_.clear(); }
  [[nodiscard]] LinkPace pace() const;

 private:
  struct Reading {
    Clock::time_point at;
    LinkTraffic traffic;
    Clock::duration roundTrip;
  };
  /// Five seconds: long enough to be steady, short enough to be live.
  static constexpr std::size_t kKept = 6;
  std::deque<Reading> readings_;
};

}  // namespace grove::node
