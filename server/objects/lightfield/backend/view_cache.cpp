#include "objects/lightfield/backend/view_cache.h"

#include <functional>
#include <iterator>

namespace grove::objects::lightfield {

std::size_t ViewCache::Hash::operator()(const ViewKey& key) const noexcept {
  std::uint64_t mixed = std::hash<world::ObjectId>()(key.object);
  const CellId& cell = key.cell;
  for (const int part :
       {cell.focal, cell.shell, cell.layer, cell.band, cell.column, cell.error, cell.version, cell.coarse ? 1 : 0}) {
    mixed = (mixed ^ static_cast<std::uint32_t>(part)) * 0x9E3779B97F4A7C15U;
    mixed ^= mixed >> 29U;
  }
  return mixed;
}

ViewCache::ViewCache(std::size_t mostBytes, pipeline::MemoryLedger& memory)
    : mostBytes_(mostBytes), held_(memory, "shared views", "lightfield", pipeline::Work::kAcrossUser) {}

std::shared_ptr<const CachedView> ViewCache::find(const ViewKey& key) {
  const std::lock_guard lock(mutex_);
  const auto place = places_.find(key);
  if (place == places_.end()) {
    ++misses_;
    return nullptr;
  }
  ++hits_;
  entries_.splice(entries_.begin(), entries_, place->second);
  return place->second->view;
}

std::shared_ptr<const CachedView> ViewCache::keep(const ViewKey& key, std::shared_ptr<const CachedView> view) {
  const std::size_t bytes = view->bytes();
  if (bytes > mostBytes_) return view;
  std::list<Entry> given;  // up: their memory is freed after the lock
  const std::lock_guard lock(mutex_);
  const auto place = places_.find(key);
  if (place != places_.end()) {
    entries_.splice(entries_.begin(), entries_, place->second);
    return place->second->view;
  }
  while (bytes_ + bytes > mostBytes_) {
    const auto last = std::prev(entries_.end());
    bytes_ -= last->view->bytes();
    places_.erase(last->key);
    given.splice(given.end(), entries_, last);
  }
  entries_.push_front({key, view});
  places_.emplace(key, entries_.begin());
  bytes_ += bytes;
  held_.set(bytes_);
  return view;
}

ViewCache::Statistics ViewCache::statistics() const {
  const std::lock_guard lock(mutex_);
  return {hits_, misses_, bytes_, entries_.size()};
}

}  // namespace grove::objects::lightfield
