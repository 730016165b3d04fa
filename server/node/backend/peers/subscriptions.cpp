#include "node/backend/peers/subscriptions.h"

#include <algorithm>
#include <cstdint>

#include "node/limits.h"
#include "pipeline/clocks.h"

namespace grove::node {
namespace {

/// Versions wrap around: 0 follows the highest.
bool isNewer(Version version, Version than) { return static_cast<std::int32_t>(version - than) > 0; }

}  // namespace

bool Subscriptions::begin(const SharedKey& what) {
  const std::lock_guard lock(mutex_);
  if (subscriptions_.size() == kMax && !subscriptions_.contains(what)) return false;
  subscriptions_[what] = {.deadline = pipeline::wallSeconds() + kMaxSeconds};
  return true;
}

void Subscriptions::end(const SharedKey& what) {
  const std::lock_guard lock(mutex_);
  subscriptions_.erase(what);
}

void Subscriptions::clear() {
  const std::lock_guard lock(mutex_);
  subscriptions_.clear();
}

bool Subscriptions::published(const SharedKey& what, Version version) {
  std::unique_lock lock(mutex_);
  const auto found = subscriptions_.find(what);
  if (found == subscriptions_.end()) return false;
  Subscription& subscription = found->second;
  if (subscription.deadline && *subscription.deadline < pipeline::wallSeconds()) {
    subscriptions_.erase(found);
    return false;
  }
  subscription.newest = version;
  askIfDue(std::move(lock), what, subscription);
  return true;
}

void Subscriptions::sent(const SharedKey& what, Version version, bool pushed) {
  std::unique_lock lock(mutex_);
  const auto found = subscriptions_.find(what);
  if (found == subscriptions_.end()) return;
  Subscription& subscription = found->second;
  // This version belongs to an earlier subscription to the key.
  if (pushed && !subscription.sent) return;
  subscription.sent = version;
  subscription.deadline.reset();
  // Over a link without delay, the acknowledgement may arrive first.
  if (pushed && subscription.acknowledged != version) subscription.unacknowledged.push_back(version);
  askIfDue(std::move(lock), what, subscription);
}

void Subscriptions::acknowledged(const SharedKey& what, Version version) {
  std::unique_lock lock(mutex_);
  const auto found = subscriptions_.find(what);
  if (found == subscriptions_.end()) return;
  Subscription& subscription = found->second;
  subscription.acknowledged = version;
  std::erase_if(subscription.unacknowledged, [version](Version sent) { return !isNewer(sent, version); });
  askIfDue(std::move(lock), what, subscription);
}

void Subscriptions::askIfDue(std::unique_lock<std::mutex> lock, const SharedKey& what, Subscription& subscription) {
  if (subscription.deadline || !subscription.newest || !subscription.sent) return;
  if (!isNewer(*subscription.newest, *subscription.sent)) return;
  if (subscription.unacknowledged.size() >= kMaxUnacknowledged) return;
  subscription.deadline = pipeline::wallSeconds() + kMaxSeconds;
  const Version known = *subscription.sent;
  lock.unlock();
  if (ask_(what, known)) return;
  lock.lock();
  const auto found = subscriptions_.find(what);
  if (found != subscriptions_.end()) found->second.deadline.reset();
}

}  // namespace grove::node
