#include "node/backend/peers/peers.h"

#include <algorithm>

namespace grove::node {

bool Peers::add(const std::shared_ptr<Peer>& peer, ProcessId process) {
  const std::lock_guard lock(mutex_);
  if (!peers_.try_emplace(process, peer).second) return false;
  peer->welcomeAs(process);
  return true;
}

void Peers::remove(Peer& peer) {
  const std::lock_guard lock(mutex_);
  peer.dismiss();
  std::erase_if(peers_, [&](const auto& each) { return each.second.get() == &peer; });
}

bool Peers::empty() const {
  const std::lock_guard lock(mutex_);
  return peers_.empty();
}

class Peers::Announcing {
 public:
  explicit Announcing(Peers& peers) : peers_(peers) {
    const std::lock_guard lock(peers_.mutex_);
    ++peers_.announcing_;
  }
  ~Announcing() {
    const std::lock_guard lock(peers_.mutex_);
    // With the lock held: the waiting thread may destroy the peers as soon as it is notified.
    if (--peers_.announcing_ == 0) peers_.announced_.notify_all();
  }
  Announcing(const Announcing&) = delete;
  Announcing& operator=(const Announcing&) = delete;

 private:
  Peers& peers_;
};

void Peers::announce(const Announcement& announcement) {
  const Announcing inProgress(*this);
  for (const auto& peer : all()) {
    if (!peer->subscriptions().published(announcement.what, announcement.version)) {
      peer->link().send(ToFrontend(announcement));
    }
  }
}

void Peers::awaitAnnouncements() {
  std::unique_lock lock(mutex_);
  announced_.wait(lock, [this] { return announcing_ == 0; });
}

void Peers::send(const ToFrontend& message) const {
  for (const auto& peer : all()) peer->link().send(message);
}

std::optional<int> Peers::quality() const {
  std::optional<int> best;
  for (const auto& peer : all()) best = std::max(best.value_or(0), peer->quality());
  return best;
}

std::vector<std::shared_ptr<Peer>> Peers::all() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<Peer>> peers;
  peers.reserve(peers_.size());
  for (const auto& [process, peer] : peers_) peers.push_back(peer);
  return peers;
}

}  // namespace grove::node
