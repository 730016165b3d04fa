#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

#include "base/lru_table.h"
#include "node/limits.h"
#include "node/messages/wire/wire.h"

namespace grove::node {

/// The views that requests of one link may name: those of each session's newest seconds, in which a backdrop may be
/// extended. They take at most kMaxBytes in total, including those that requests still hold. If that is not enough,
/// drops the views of the least recently used session first. One thread at a time.
class SentViews {
 public:
  static constexpr std::size_t kMostKept = 256;  ///< of a session; more than a visitor's frames in that time
  static constexpr std::size_t kMaxBytes = std::size_t{64} << 20U;

  /// A view without room, because requests in progress hold the others, stays unknown.
  void add(std::shared_ptr<const View> view);
  void forget(SessionId session) { sessions_.take(session); }
  /// Must not outlive this.
  [[nodiscard]] ViewLookup lookup() {
    return [this](SessionId session, FrameNumber frame) { return find(session, frame); };
  }

 private:
  [[nodiscard]] std::shared_ptr<const View> find(SessionId session, FrameNumber frame);
  void forgetOldest();

  /// Outlives this with views that requests in progress hold.
  const std::shared_ptr<std::atomic<std::size_t>> bytes_ = std::make_shared<std::atomic<std::size_t>>(0);
  LruTable<SessionId, std::vector<std::shared_ptr<const View>>> sessions_;  ///< the oldest view first
};

}  // namespace grove::node
