#pragma once

#include <deque>
#include <mutex>
#include <optional>

#include "node/messages/ids.h"

namespace grove::stream {

/// Limits the cost of first frames for the visitors who are already in the world. A newcomer's first frame takes
/// several times as long as any other, because nothing is drawn yet. First frames are made one at a time, first come,
/// first served, and paid from a bucket of seconds: a few simultaneous newcomers do not wait, and in the long run
/// newcomers take a small share of the machine, however many come and go. Thread-safe; times are monotonic seconds.
class EntryBudget {
 public:
  /// `cores`: number that make frames.
  explicit EntryBudget(int cores);

  /// Returns whether this session may begin its first frame, or has begun it. Call repeatedly; a session that stops
  /// calling does not delay others.
  [[nodiscard]] bool mayBegin(node::SessionId session, double now);
  /// The session's first frame is made, or the session has ended.
  void end(node::SessionId session, double now);

 private:
  struct Waiter {
    node::SessionId session;
    double asked;
  };
  struct Entry {
    node::SessionId session;
    double began;
  };
  void fill(double now);
  void finish(double now);

  const double rate_;  ///< seconds that the bucket gains per second
  std::mutex mutex_;
  std::deque<Waiter> waiting_;
  std::optional<Entry> entry_;
  double seconds_;       ///< in the bucket, or owed if negative
  double filled_ = 0.0;  ///< time of the last gain
};

}  // namespace grove::stream
