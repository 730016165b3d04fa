#include "objects/lightfield/frontend/late_views.h"

namespace grove::objects::lightfield {

std::optional<CellId> LateViews::last(const node::View& view, world::ObjectId object) {
  const std::lock_guard lock(mutex_);
  const auto place = places_.find({view.session, object});
  if (place == places_.end()) return std::nullopt;
  return place->second->cell;
}

std::optional<LateViews::Fading> LateViews::fading(const node::View& view, world::ObjectId object) {
  const std::lock_guard lock(mutex_);
  const auto place = places_.find({view.session, object});
  if (place == places_.end()) return std::nullopt;
  const Entry& entry = *place->second;
  const double seconds = view.time - entry.since;
  if (entry.from.version == entry.cell.version || seconds >= CrossFade::kSeconds) return std::nullopt;
  return Fading{entry.from, CrossFade::shareAfter(seconds)};
}

void LateViews::shown(const node::View& view, world::ObjectId object, const CellId& cell) {
  const Key key{view.session, object};
  const std::lock_guard lock(mutex_);
  if (const auto place = places_.find(key); place != places_.end()) {
    Entry& entry = *place->second;
    if (entry.cell.version < cell.version) {
      entry.from = entry.cell;
      entry.since = view.time;
    }
    entry.cell = cell;
    entries_.splice(entries_.begin(), entries_, place->second);
    return;
  }
  entries_.push_front({key, cell, cell, view.time});
  places_[key] = entries_.begin();
  if (entries_.size() <= kMostEntries) return;
  places_.erase(entries_.back().key);
  entries_.pop_back();
}

}  // namespace grove::objects::lightfield
