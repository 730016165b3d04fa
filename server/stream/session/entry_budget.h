#pragma once

#include <deque>
#include <mutex>
#include <optional>
#include <set>

#include "node/messages/ids.h"

namespace grove::stream {

/// Limits what first frames may cost those who are in the world already: a newcomer's takes several times as long as
/// any other, since nothing is drawn yet. One is made at a time, first come, first served. After it the next one waits,
/// the longer the more visitors are inside and the fewer wait. Any thread; times are seconds that do not go back.
class EntryBudget {
 public:
  /// `cores`: that make frames.
  explicit EntryBudget(int cores) : cores_(cores) {}

  /// Whether this session may begin its first frame, or has begun it. To be asked again and again; a session that no
  /// longer asks keeps nobody waiting.
  [[nodiscard]] bool mayBegin(node::SessionId session, double now);
  /// Its first frame is made.
  void enter(node::SessionId session, double now);
  /// It is gone, inside or not.
  void leave(node::SessionId session, double now);

 private:
  struct Waiter {
    node::SessionId session;
    double asked;
  };
  struct Entry {
    node::SessionId session;
    double began;
  };
  void finish(double now);
  void forgetStale(double now);
  /// Seconds to wait for each second that a first frame took.
  [[nodiscard]] double restPerSecond() const;

  const int cores_;
  std::mutex mutex_;
  std::set<node::SessionId> inside_;
  std::deque<Waiter> waiting_;
  std::optional<Entry> entry_;
  double next_ = 0.0;
};

}  // namespace grove::stream
