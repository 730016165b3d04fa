#pragma once

#include <chrono>
#include <cstddef>
#include <deque>

#include "node/transport/transport.h"

namespace grove::node {

/// How fast a link is, from a reading a second. One thread at a time.
class LinkGauge {
 public:
  using Clock = std::chrono::steady_clock;

  /// What has travelled by then, and how long an answer has just taken.
  void read(Clock::time_point now, const LinkTraffic& traffic, Clock::duration roundTrip);
  /// The link has gone.
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
