#include "node/frontend/shared/shared_store.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <string>
#include <utility>

#include "pipeline/clocks.h"

namespace grove::node {
namespace {

/// For what is fetched without a frame that waits for it.
constexpr double kFetchSeconds = 1.0;

}  // namespace

std::shared_ptr<const SharedData> SharedStore::find(const SharedKey& what) {
  Found found;
  {
    const std::lock_guard lock(mutex_);
    found = use(what);
  }
  if (found.isStale) fetchNewer(what, found.known);
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
  const bool isStale = wantsNewer(what, *entry);
  if (isStale) pending_[what].deadline = pipeline::wallSeconds() + kFetchSeconds;
  return {entry->data, isStale, entry->known()};
}

SharedStore::Entry* SharedStore::entryOf(const SharedKey& what) {
  if (!what.key.empty()) return entries_.find(what);
  const auto found = objects_.find(what.object);
  return found == objects_.end() ? nullptr : &found->second;
}

bool SharedStore::wantsNewer(const SharedKey& what, const Entry& entry) const {
  if (!entry.used || !entry.isStale) return false;
  const auto pending = pending_.find(what);
  return pending == pending_.end() || pending->second.deadline < pipeline::wallSeconds();
}

void SharedStore::fetchNewer(const SharedKey& what, Version known) {
  Request request;
  request.known = known;
  request.object = what.object;
  request.shared = true;
  request.key = what.key;
  fetch(std::move(request));
}

void SharedStore::fetch(Request request) {
  const SharedKey what{request.object, request.key};
  std::string reason = "the backend node is full";
  try {
    if (fetch_(std::move(request))) return;
  } catch (const std::exception& e) {
    reason = e.what();
  }
  for (const Waiting& waiting : takeWaiting(what)) waiting.waiter(Failure{reason, true});
}

void SharedStore::get(const Request& request, Waiter waiter) {
  const SharedKey what{request.object, request.key};
  std::unique_lock lock(mutex_);
  if (const Found found = use(what); found.data) {
    lock.unlock();
    if (found.isStale) fetchNewer(what, found.known);
    waiter(found.data);
    return;
  }
  const double now = pipeline::wallSeconds();
  const auto [known, isNew] = pending_.try_emplace(what);
  Pending& pending = known->second;
  pending.waiting.push_back({request.view->deadline, std::move(waiter)});
  if (!isNew && now <= pending.deadline) return;
  pending.deadline = request.view->deadline;
  const std::vector<Waiting> late = takeLate(pending, now);
  lock.unlock();
  for (const Waiting& waiting : late) waiting.waiter(Failure{"the backend node did not answer in time", true});
  fetch(request);
}

/// A backend node that never answers must not let them grow without bound.
std::vector<SharedStore::Waiting> SharedStore::takeLate(Pending& pending, double now) {
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

bool SharedStore::awaits(const SharedKey& what) const {
  const std::lock_guard lock(mutex_);
  return pending_.contains(what);
}

bool SharedStore::put(const Result& result) {
  const SharedKey& what = result.what;
  const auto* const data = std::get_if<std::shared_ptr<const SharedData>>(&result.payload);
  std::vector<Entry> given;  // their memory is freed after the lock
  std::vector<Waiting> waiting;
  {
    const std::lock_guard lock(mutex_);
    auto pending = pending_.extract(what);
    if (pending.empty()) return false;
    waiting = std::move(pending.mapped().waiting);
    if (data != nullptr && *data != nullptr) {
      const bool isStale = pending.mapped().announced > (*data)->version();
      keep(what, {*data, (*data)->bytes(), isStale, false, false}, given);
    }
  }
  for (const Waiting& each : waiting) each.waiter(result.payload);
  return true;
}

void SharedStore::keep(const SharedKey& what, Entry entry, std::vector<Entry>& given) {
  if (what.key.empty()) {
    given.push_back(std::exchange(objects_[what.object], std::move(entry)));
    return;
  }
  bytes_ += entry.bytes;
  if (auto replaced = entries_.put(what, std::move(entry))) {
    bytes_ -= replaced->bytes;
    given.push_back(std::move(*replaced));
  }
  makeRoom(given);
}

void SharedStore::makeRoom(std::vector<Entry>& given) {
  while (bytes_ > maxBytes_ && !entries_.empty()) {
    Entry oldest = entries_.takeOldest().value;
    bytes_ -= oldest.bytes;
    given.push_back(std::move(oldest));
  }
}

void SharedStore::renew(const std::function<bool(world::ObjectId)>& isOfNode, bool restarted) {
  const std::lock_guard lock(mutex_);
  const auto age = [&](Entry& entry) {
    entry.isStale = true;
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
  // What is under way may have been lost with the link: who wants it next asks again.
  for (auto& [what, pending] : pending_) {
    if (isOfNode(what.object)) pending = {0.0, 0, std::move(pending.waiting)};
  }
}

void SharedStore::announced(const Announcement& announcement) {
  const SharedKey& what = announcement.what;
  Version known = 0;
  {
    const std::lock_guard lock(mutex_);
    // The last one counts, not the highest, which no later one could contradict.
    const auto underWay = pending_.find(what);
    if (underWay != pending_.end()) underWay->second.announced = announcement.version;
    Entry* const entry = entryOf(what);
    if (entry == nullptr) return;
    entry->isStale = entry->isForeign || announcement.version != entry->data->version();
    if (!wantsNewer(what, *entry)) return;
    Pending& pending = pending_[what];
    pending.deadline = pipeline::wallSeconds() + kFetchSeconds;
    pending.announced = announcement.version;
    known = entry->known();
  }
  fetchNewer(what, known);
}

SharedStore::Statistics SharedStore::statistics() const {
  const std::lock_guard lock(mutex_);
  Statistics statistics{bytes_, entries_.size() + objects_.size()};
  for (const auto& [object, entry] : objects_) statistics.bytes += entry.bytes;
  return statistics;
}

}  // namespace grove::node
