#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "node/messages/ids.h"
#include "node/messages/world_update.h"
#include "node/transport/peer_clock.h"

namespace grove::node {

/// A backend node's copy of the world's state: players, gusts and time. The first frontend process that sends updates
/// owns the world until it leaves; updates of others are refused, because each process has its own clock and a
/// simulation can follow only one. Thread-safe.
class WorldMirror {
 public:
  /// Number of updates received.
  using Cursor = std::uint64_t;

  /// Applies an update; false if another process owns the world. An update slightly older than the newest is ignored.
  /// A much lower number restarts the numbering, so a wrong number cannot block later updates.
  bool apply(ProcessId from, std::shared_ptr<const WorldUpdate> update);
  /// A process leaves. If it owns the world, the mirror is emptied and the next process that sends an update owns it.
  void leave(ProcessId owner);

  /// Seconds of the world's clock; nothing before the first update.
  [[nodiscard]] std::optional<double> now() const;

  /// All players as of the newest update.
  [[nodiscard]] std::vector<world::Player> players() const;

  /// Returns each visitor's newest gust in the updates after `cursor`, and advances the cursor.
  [[nodiscard]] std::vector<world::Gust> gusts(Cursor& cursor) const;

  /// Calls `wake` at each update while there are visitors, until the returned token is destroyed. `wake` must not block
  /// or use this object.
  [[nodiscard]] std::shared_ptr<void> whileVisited(std::function<void()> wake) const;

 private:
  /// Kept updates with gusts: two seconds.
  static constexpr std::size_t kKept = 64;
  /// An update that is this far behind is late.
  static constexpr std::uint64_t kLate = 64;
  struct Past {
    Cursor number = 0;
    std::vector<world::Gust> gusts;
  };
  mutable std::mutex mutex_;
  PeerClock clock_;
  std::optional<ProcessId> owner_;
  std::shared_ptr<const WorldUpdate> newest_ = std::make_shared<const WorldUpdate>();
  Cursor count_ = 0;
  std::vector<Past> past_;  ///< the oldest first
  mutable std::vector<std::weak_ptr<const std::function<void()>>> wakes_;
};

}  // namespace grove::node
