#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "base/lru_table.h"
#include "node/messages/wire.h"

namespace grove::node {

/// The views that requests may name: the newest of each session, of at most kMaxSessions, those that were silent
/// longest forgotten first. One thread at a time.
class SentViews {
 public:
  static constexpr std::size_t kKept = 32;
  static constexpr std::size_t kMaxSessions = 4096;

  void add(std::shared_ptr<const View> view);
  void forget(SessionId session) { sessions_.take(session); }
  /// Must not outlive this.
  [[nodiscard]] ViewLookup lookup() {
    return [this](SessionId session, FrameNumber frame) { return find(session, frame); };
  }

 private:
  [[nodiscard]] std::shared_ptr<const View> find(SessionId session, FrameNumber frame);

  LruTable<SessionId, std::vector<std::shared_ptr<const View>>> sessions_;  ///< the oldest view first
};

}  // namespace grove::node
