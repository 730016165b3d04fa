#include "objects/lightfield/cache/late_views.h"

namespace grove::objects::lightfield {

std::optional<CellId> LateViews::last(const node::View& view, world::ObjectId object) {
  const std::lock_guard lock(mutex_);
  const auto place = places_.find({view.session, object});
  if (place == places_.end()) return std::nullopt;
  return place->second->cell;
}

void LateViews::shown(const node::View& view, world::ObjectId object, const CellId& cell) {
  const Key key{view.session, object};
  const std::lock_guard lock(mutex_);
  if (const auto place = places_.find(key); place != places_.end()) {
    place->second->cell = cell;
    entries_.splice(entries_.begin(), entries_, place->second);
    return;
  }
  entries_.push_front({key, cell});
  places_[key] = entries_.begin();
  if (entries_.size() <= kMostEntries) return;
  places_.erase(entries_.back().key);
  entries_.pop_back();
}

}  // namespace grove::objects::lightfield
