#include "objects/lightfield/frontend/last_views.h"

#include <utility>

namespace grove::objects::lightfield {

std::optional<CellId> LastViews::last(world::ObjectId object) const {
  const std::lock_guard lock(mutex_);
  const auto entry = entries_.find(object);
  if (entry == entries_.end()) return std::nullopt;
  return entry->second.cell;
}

void LastViews::shown(world::ObjectId object, const CellId& cell, double time,
                      std::shared_ptr<const CachedView> former) {
  const std::lock_guard lock(mutex_);
  const auto [entry, isNew] = entries_.try_emplace(object, Entry{cell, nullptr, time});
  Entry& known = entry->second;
  if (!isNew && known.cell.version < cell.version) {
    known.former = std::move(former);
    known.since = time;
  } else if (time - known.since >= CrossFade::kSeconds) {
    known.former = nullptr;
  }
  known.cell = cell;
}

CrossFade LastViews::fade(world::ObjectId object, double time) const {
  const std::lock_guard lock(mutex_);
  const auto entry = entries_.find(object);
  if (entry == entries_.end() || !entry->second.former) return {};
  const double seconds = time - entry->second.since;
  if (seconds >= CrossFade::kSeconds) return {};
  return {entry->second.former, CrossFade::shareAfter(seconds)};
}

void LastViews::endFade(world::ObjectId object) {
  const std::lock_guard lock(mutex_);
  const auto entry = entries_.find(object);
  if (entry != entries_.end()) entry->second.former = nullptr;
}

}  // namespace grove::objects::lightfield
