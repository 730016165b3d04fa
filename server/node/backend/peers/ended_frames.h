#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/lru_table.h"
#include "node/messages/request.h"

namespace grove::node {

/// Frames that a frontend process ended before their requests were answered. Keeps at most kMaxSessions sessions and
/// drops those that have ended no frame for the longest time: their late requests are then served although no frame
/// waits. One thread at a time.
class EndedFrames {
 public:
  static constexpr std::size_t kMaxSessions = 4096;

  void add(const Cancel& cancel) {
    if (FrameNumber* const newest = newest_.use(cancel.session)) {
      *newest = std::max(*newest, cancel.frame);
      return;
    }
    if (newest_.size() == kMaxSessions) newest_.takeOldest();
    newest_.put(cancel.session, cancel.frame);
  }

  /// Adds a session that may have ended no frame yet.
  void addSession(SessionId session) { add({.session = session, .frame = 0}); }

  /// Sessions added by addSession() or by an ended frame.
  [[nodiscard]] std::vector<SessionId> sessions() const {
    std::vector<SessionId> sessions;
    sessions.reserve(newest_.size());
    for (const auto& entry : newest_.entries()) sessions.push_back(entry.key);
    return sessions;
  }

  void forget(SessionId session) { newest_.take(session); }

  [[nodiscard]] bool contain(const View& view) const {
    const FrameNumber* const newest = newest_.find(view.session);
    return newest != nullptr && view.frame <= *newest;
  }

 private:
  LruTable<SessionId, FrameNumber> newest_;
};

}  // namespace grove::node
