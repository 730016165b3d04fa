#pragma once

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "node/backend/peers/peer.h"

namespace grove::node {

/// The welcomed frontend processes of a backend node, by process number. Thread-safe.
class Peers {
 public:
  /// Welcomes a peer; false if another peer has this number.
  [[nodiscard]] bool add(const std::shared_ptr<Peer>& peer, ProcessId process);
  void remove(Peer& peer);
  [[nodiscard]] bool empty() const;

  /// Sends the new version to peers with a subscription, and the announcement to all others. Holds no lock meanwhile,
  /// because a receiver may call back.
  void announce(const Announcement& announcement);
  /// Waits for announcements in progress, which may still reach peers that have left meanwhile.
  void awaitAnnouncements();
  /// Sends a message to all peers.
  void send(const ToFrontend& message) const;
  /// The highest quality step that any peer requests; nothing if there are no peers.
  [[nodiscard]] std::optional<int> quality() const;

 private:
  class Announcing;
  [[nodiscard]] std::vector<std::shared_ptr<Peer>> all() const;

  mutable std::mutex mutex_;
  std::map<ProcessId, std::shared_ptr<Peer>> peers_;
  int announcing_ = 0;
  std::condition_variable announced_;
};

}  // namespace grove::node
