#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "node/messages/shared_key.h"

namespace grove::node {

/// The shared data of which a peer gets each new version without a request. Makes one version per key at a time, and
/// sends at most kMaxUnacknowledged versions that the peer has not acknowledged. Versions published meanwhile are
/// skipped: when there is room again, the newest is sent. So a slow link has no backlog. Thread-safe.
class Subscriptions {
 public:
  static constexpr std::size_t kMax = 256;
  /// A version that takes longer counts as lost. The subscription ends, so the next version is announced.
  static constexpr double kMaxSeconds = 1.0;

  /// Starts to make the newest version and to send it to the peer, as a change to version `known`. Returns false if the
  /// node's queue is full. Called without a lock; must not block.
  using Ask = std::function<bool(const SharedKey& what, Version known)>;

  /// Must be called before the first begin().
  void connect(Ask ask) { ask_ = std::move(ask); }

  /// Adds or restarts a subscription, before its request is answered. Returns false if the peer has kMax subscriptions.
  [[nodiscard]] bool begin(const SharedKey& what);
  void end(const SharedKey& what);
  void clear();

  /// Handles a new version. Returns false if the peer has not subscribed to the key.
  [[nodiscard]] bool published(const SharedKey& what, Version version);
  /// Records that a version was sent: as the answer to the request that subscribed, or `pushed` after it.
  void sent(const SharedKey& what, Version version, bool pushed);
  /// The peer has this version.
  void acknowledged(const SharedKey& what, Version version);

 private:
  struct Subscription {
    std::optional<Version> newest = {};  ///< published
    std::optional<Version> sent = {};    ///< nothing before the first answer
    Version acknowledged = 0;
    std::optional<double> deadline = {};       ///< of the version in progress
    std::vector<Version> unacknowledged = {};  ///< pushed, the oldest first
  };

  /// Requests the newest version if it is due. Unlocks.
  void askIfDue(std::unique_lock<std::mutex> lock, const SharedKey& what, Subscription& subscription);

  Ask ask_;
  std::mutex mutex_;
  std::map<SharedKey, Subscription> subscriptions_;
};

}  // namespace grove::node
