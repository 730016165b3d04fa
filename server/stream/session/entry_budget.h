#pragma once

#include <deque>
#include <mutex>
#include <optional>

#include "node/messages/ids.h"

namespace grove::stream {

/// Limits what first frames may cost those who are in the world already: a newcomer's takes several times as long as
/// any other, since nothing is drawn yet. One is made at a time, first come, first served, and paid from a bucket of
/// seconds: some who come at once need not wait, and in the long run newcomers take a small share of the machine,
/// however many come and go. Any thread; times are seconds that do not go back.
class EntryBudget {
 public:
  /// `cores`: that make frames.
  explicit EntryBudget(int cores);

  /// Whether this session may begin its first frame, or has begun it. To be asked again and again; a session that no
  /// longer asks keeps nobody waiting.
  [[nodiscard]] bool mayBegin(node::SessionId session, double now);
  /// Its first frame is made, or it is gone.
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

  const double rate_;  ///< seconds that the bucket gets in a second
  std::mutex mutex_;
  std::deque<Waiter> waiting_;
  std::optional<Entry> entry_;
  double seconds_;       ///< in the bucket, or owed if negative
  double filled_ = 0.0;  ///< when
};

}  // namespace grove::stream
