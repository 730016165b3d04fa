#include "node/frontend/shared/shared_store.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <string>
#include <utility>

#include "node/limits.h"
#include "pipeline/clocks.h"

namespace grove::node {
namespace {

/// Deadline of a fetch for which no frame waits.
constexpr double kFetchSeconds = 1.0;

}  // namespace

std::shared_ptr<const SharedData> SharedStore::find(const SharedKey& what) {
  Found found;
  {
    const std::lock_guard lock(mutex_);
    found = use(what);
  }
  if (found.newer) fetch(std::move(*found.newer));
  return found.data;
}

std::shared_ptr<const SharedData> SharedStore::known(const SharedKey& what) {
  const std::lock_guard lock(mutex_);
  const Entry* const entry = entryOf(what);
  return entry == nullptr || entry->isForeign ? nullptr : entry->data;
}

SharedStore::Found SharedStore::use(const SharedKey& what) {
  Entry* const entry = what.key.empty() ? entryOf(what) : entries_.use(what);
  if (entry == nullptr) return {};
  entry->used = true;
  return {entry->data, newerThan(what, *entry)};
}

SharedStore::Entry* SharedStore::entryOf(const SharedKey& what) {
  if (!what.key.empty()) return entries_.find(what);
  const auto found = objects_.find(what.object);
  return found == objects_.end() ? nullptr : &found->second;
}

std::optional<Request> SharedStore::newerThan(const SharedKey& what, const Entry& entry) {
  if (!entry.used || !entry.isStale) return std::nullopt;
  const double now = pipeline::wallSeconds();
  const auto [underWay, isNew] = pending_.try_emplace(what);
  Pending& pending = underWay->second;
  if (!isNew && pending.deadline >= now) return std::nullopt;
  pending.deadline = now + kFetchSeconds;
  pending.subscribes = entry.data->isClocked();
  Request request;
  request.known = entry.known();
  request.object = what.object;
  request.shared = true;
  request.key = what.key;
  request.subscribe = pending.subscribes;
  return request;
}

void SharedStore::fetch(Request request) {
  const SharedKey what{request.object, request.key};
  std::string reason = "the backend node is full";
  try {
    if (send_(std::move(request))) return;
  } catch (const std::exception& e) {
    reason = e.what();
  }
  for (const Waiting& waiting : takeWaiting(what)) waiting.waiter(Failure{reason, true});
}

void SharedStore::get(const Request& request, Waiter waiter) {
  const SharedKey what{request.object, request.key};
  std::unique_lock lock(mutex_);
  if (Found found = use(what); found.data) {
    lock.unlock();
    if (found.newer) fetch(std::move(*found.newer));
    waiter(found.data);
    return;
  }
  const double now = pipeline::wallSeconds();
  const auto [known, isNew] = pending_.try_emplace(what);
  Pending& pending = known->second;
  pending.waiting.push_back({request.view->deadline, std::move(waiter)});
  if (!isNew && now <= pending.deadline) return;
  pending.deadline = request.view->deadline;
  const std::vector<Waiting> late = takeOverdue(pending, now);
  lock.unlock();
  for (const Waiting& waiting : late) waiting.waiter(Failure{"the backend node did not respond in time", true});
  fetch(request);
}

/// Requests to a backend node that does not respond must not accumulate.
std::vector<SharedStore::Waiting> SharedStore::takeOverdue(Pending& pending, double now) {
  std::vector<Waiting>& all = pending.waiting;
  const auto over = std::partition(all.begin(), all.end(), [now](const Waiting& w) { return now <= w.deadline; });
  std::vector<Waiting> late(std::make_move_iterator(over), std::make_move_iterator(all.end()));
  all.erase(over, all.end());
  return late;
}

std::vector<SharedStore::Waiting> SharedStore::takeWaiting(const SharedKey& what) {
  const std::lock_guard lock(mutex_);
  auto pending = pending_.extract(what);
  return pending.empty() ? std::vector<Waiting>() : std::move(pending.mapped().waiting);
}

bool SharedStore::awaits(const Result& result) {
  const std::lock_guard lock(mutex_);
  if (!result.pushed) return pending_.contains(result.what);
  const Entry* const entry = entryOf(result.what);
  return entry != nullptr && entry->isSubscribed;
}

bool SharedStore::put(const Result& result) {
  if (result.pushed) return putPushed(result);
  const SharedKey& what = result.what;
  const auto* const data = std::get_if<std::shared_ptr<const SharedData>>(&result.payload);
  std::vector<Entry> discarded;  // their memory is freed after the lock
  std::vector<Waiting> waiting;
  {
    const std::lock_guard lock(mutex_);
    auto pending = pending_.extract(what);
    if (pending.empty()) return false;
    waiting = std::move(pending.mapped().waiting);
    if (data != nullptr && *data != nullptr) {
      keep(what,
           {.data = *data,
            .bytes = (*data)->bytes(),
            .isStale = pending.mapped().announced > (*data)->version(),
            .isSubscribed = pending.mapped().subscribes},
           discarded);
    }
  }
  for (const Waiting& each : waiting) each.waiter(result.payload);
  return true;
}

bool SharedStore::putPushed(const Result& result) {
  const SharedKey& what = result.what;
  const auto* const data = std::get_if<std::shared_ptr<const SharedData>>(&result.payload);
  std::vector<Entry> discarded;  // their memory is freed after the lock
  std::optional<ToBackend> reply;
  bool isAwaited = false;
  {
    const std::lock_guard lock(mutex_);
    Entry* const last = entryOf(what);
    isAwaited = last != nullptr && last->isSubscribed;
    if (!isAwaited) {
      // During a renewed subscription, this version was sent before it.
      if (!pending_.contains(what)) reply = Unsubscribe{what};
    } else if (data != nullptr && *data != nullptr) {
      reply = keepPushed(what, *data, discarded);
    } else {
      last->isStale = true;
      last->isSubscribed = false;
    }
  }
  if (reply) (void)send_(std::move(*reply));
  return isAwaited;
}

std::optional<ToBackend> SharedStore::keepPushed(const SharedKey& what, std::shared_ptr<const SharedData> data,
                                                 std::vector<Entry>& discarded) {
  const Version version = data->version();
  const Entry& last = *entryOf(what);
  const std::size_t pushed = last.pushed + 1;
  const std::size_t unused = last.used ? 0 : last.unused + 1;
  const bool isWanted = unused < kMaxUnused;
  const std::size_t bytes = data->bytes();
  // Later versions may arrive before the node receives the Unsubscribe; they are dropped.
  keep(what,
       {.data = std::move(data),
        .bytes = bytes,
        .isStale = !isWanted,
        .isSubscribed = isWanted,
        .pushed = pushed,
        .unused = unused},
       discarded);
  if (!isWanted) return Unsubscribe{what};
  if (pushed % kAcknowledgedAtOnce == 0) return Acknowledgement{what, version};
  return std::nullopt;
}

void SharedStore::keep(const SharedKey& what, Entry entry, std::vector<Entry>& discarded) {
  if (what.key.empty()) {
    discarded.push_back(std::exchange(objects_[what.object], std::move(entry)));
    return;
  }
  bytes_ += entry.bytes;
  if (auto replaced = entries_.put(what, std::move(entry))) {
    bytes_ -= replaced->bytes;
    discarded.push_back(std::move(*replaced));
  }
  makeRoom(discarded);
}

void SharedStore::makeRoom(std::vector<Entry>& discarded) {
  while (bytes_ > maxBytes_ && !entries_.empty()) {
    Entry oldest = entries_.takeOldest().value;
    bytes_ -= oldest.bytes;
    discarded.push_back(std::move(oldest));
  }
}

void SharedStore::renew(const std::function<bool(world::ObjectId)>& isOfNode, bool restarted) {
  const std::lock_guard lock(mutex_);
  const auto age = [&](Entry& entry) {
    entry.isStale = true;
    entry.isSubscribed = false;
    entry.isForeign = entry.isForeign || restarted;
  };
  for (auto& [object, entry] : objects_) {
    if (isOfNode(object)) age(entry);
  }
  std::vector<SharedKey> keys;
  for (const auto& [what, entry] : entries_.entries()) {
    if (isOfNode(what.object)) keys.push_back(what);
  }
  for (const SharedKey& what : keys) age(*entries_.find(what));
  // Pending requests may have been lost with the link: the next use sends them again.
  for (auto& [what, pending] : pending_) {
    if (isOfNode(what.object)) pending = {.waiting = std::move(pending.waiting)};
  }
}

void SharedStore::announced(const Announcement& announcement) {
  const SharedKey& what = announcement.what;
  std::optional<Request> request;
  {
    const std::lock_guard lock(mutex_);
    // Uses the last one, not the highest, which no later one could correct.
    const auto underWay = pending_.find(what);
    if (underWay != pending_.end()) underWay->second.announced = announcement.version;
    Entry* const entry = entryOf(what);
    if (entry == nullptr) return;
    entry->isStale = entry->isForeign || announcement.version != entry->data->version();
    request = newerThan(what, *entry);
    if (request) pending_[what].announced = announcement.version;
  }
  if (request) fetch(std::move(*request));
}

SharedStore::Statistics SharedStore::statistics() const {
  const std::lock_guard lock(mutex_);
  Statistics statistics{bytes_, entries_.size() + objects_.size()};
  for (const auto& [object, entry] : objects_) statistics.bytes += entry.bytes;
  return statistics;
}

}  // namespace grove::node
