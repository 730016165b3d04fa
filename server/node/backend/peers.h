#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "node/backend/peer.h"

namespace grove::node {

/// The frontend processes that are welcome at a backend node, each by a number of its own. Any thread.
class Peers {
 public:
  /// It is welcome from now on; false if another one goes by this number.
  [[nodiscard]] bool add(const std::shared_ptr<Peer>& peer, ProcessId process);
  void remove(Peer& peer);
  [[nodiscard]] bool empty() const;

  /// No lock is held meanwhile, for who is told may answer at once.
  void announce(const Announcement& announcement) const;
  /// The best that any of them wants: finer work serves the others, too. Nothing while there is nobody.
  [[nodiscard]] std::optional<int> quality() const;

 private:
  [[nodiscard]] std::vector<std::shared_ptr<Peer>> all() const;

  mutable std::mutex mutex_;
  std::map<ProcessId, std::shared_ptr<Peer>> peers_;
};

}  // namespace grove::node
