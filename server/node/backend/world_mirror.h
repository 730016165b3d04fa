#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "node/backend/peer_clock.h"
#include "node/messages/ids.h"
#include "node/messages/world_update.h"

namespace grove::node {

/// What a backend node knows of the world that its owner reports: who is there, what blows, and what time it is. Of
/// several frontend processes that report, the first owns the world until it leaves: each has a clock of its own, and a
/// simulation can only follow one. Any thread.
class WorldMirror {
 public:
  /// Counts updates as they come.
  using Cursor = std::uint64_t;

  /// False if another one owns the world. An update that comes late, after a newer one, changes nothing. One whose
  /// number lies far behind begins a new count, so no number keeps those after it out.
  bool apply(ProcessId from, std::shared_ptr<const WorldUpdate> update);
  /// If it owns the world, nobody is there until another one reports.
  void leave(ProcessId owner);

  /// Seconds of the world's clock; nothing before the first update.
  [[nodiscard]] std::optional<double> now() const;

  /// Everybody as of the newest update.
  [[nodiscard]] std::vector<world::Player> players() const;

  /// What blows now or did in the updates after `cursor`, which is moved past them: of each visitor the newest gust.
  [[nodiscard]] std::vector<world::Gust> gusts(Cursor& cursor) const;

  /// Calls `wake` at each update while somebody is there, until the token that it returns is gone. `wake` must not
  /// block, nor use this.
  [[nodiscard]] std::shared_ptr<void> whileVisited(std::function<void()> wake) const;

 private:
  /// So many updates of gusts are kept: two seconds.
  static constexpr std::size_t kKept = 64;
  /// So far behind, an update is late.
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
