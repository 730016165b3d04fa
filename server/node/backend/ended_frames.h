#pragma once

#include <algorithm>
#include <cstddef>

#include "base/lru_table.h"
#include "node/messages/request.h"

namespace grove::node {

/// Frames that a frontend process has ended before their requests were answered. Of more than kMaxSessions sessions,
/// those that ended none for longest are forgotten; then what nobody waits for is answered, too. One thread
/// at a time.
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

  void forget(SessionId session) { newest_.take(session); }

  [[nodiscard]] bool contain(const View& view) const {
    const FrameNumber* const newest = newest_.find(view.session);
    return newest != nullptr && view.frame <= *newest;
  }

 private:
  LruTable<SessionId, FrameNumber> newest_;
};

}  // namespace grove::node
