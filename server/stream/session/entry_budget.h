#pragma once

#include <deque>
#include <mutex>
#include <optional>

#include "node/messages/ids.h"

namespace grove::stream {

/// Limits what first frames may cost those who are in the world already: a newcomer's takes several times as long as
/// any other, since nothing is drawn yet. One is made at a time, first come, first served, and after it the next one
/// waits for several times as long as it took. Any thread; times are seconds that do not go back.
class EntryBudget {
 public:
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
  void finish(double now);

  std::mutex mutex_;
  std::deque<Waiter> waiting_;
  std::optional<Entry> entry_;
  double next_ = 0.0;
};

}  // namespace grove::stream
