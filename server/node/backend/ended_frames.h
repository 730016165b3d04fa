#pragma once

#include <algorithm>
#include <map>
#include <mutex>

#include "node/messages/request.h"

namespace grove::node {

/// Frames that frontends have ended before their requests were answered. Any thread.
class EndedFrames {
 public:
  void add(const Cancel& cancel) {
    const std::lock_guard lock(mutex_);
    FrameNumber& newest = newest_[cancel.session];
    newest = std::max(newest, cancel.frame);
  }

  void forget(SessionId session) {
    const std::lock_guard lock(mutex_);
    newest_.erase(session);
  }

  [[nodiscard]] bool contain(const View& view) const {
    const std::lock_guard lock(mutex_);
    const auto found = newest_.find(view.session);
    return found != newest_.end() && view.frame <= found->second;
  }

 private:
  mutable std::mutex mutex_;
  std::map<SessionId, FrameNumber> newest_;
};

}  // namespace grove::node
