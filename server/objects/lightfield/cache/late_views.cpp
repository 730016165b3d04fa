#include "objects/lightfield/cache/late_views.h"

namespace grove::objects::lightfield {

std::shared_ptr<const CachedView> LateViews::lateView(const node::View& view, world::ObjectId object,
                                                      const ViewCell& cell, world::Vec3 eye) {
  const std::lock_guard lock(mutex_);
  // A session's number is never used again; this keeps those that went from staying for ever.
  if (budgets_.size() > kMostEntries) budgets_.clear();
  Budget& budget = budgets_[view.session];
  if (budget.frame != view.frame) budget = {view.frame, 0};
  if (budget.made < kMostNewPictures) {
    ++budget.made;
    return nullptr;
  }
  const auto place = places_.find({view.session, object});
  if (place == places_.end()) return nullptr;
  auto picture = place->second->picture.lock();
  if (!picture || glm::distance(picture->camera().eye, eye) > kLateness * cell.reach) return nullptr;
  return picture;
}

void LateViews::shown(const node::View& view, world::ObjectId object,
                      const std::shared_ptr<const CachedView>& picture) {
  const Key key{view.session, object};
  const std::lock_guard lock(mutex_);
  if (const auto place = places_.find(key); place != places_.end()) {
    place->second->picture = picture;
    entries_.splice(entries_.begin(), entries_, place->second);
    return;
  }
  entries_.push_front({key, picture});
  places_[key] = entries_.begin();
  if (entries_.size() <= kMostEntries) return;
  places_.erase(entries_.back().key);
  entries_.pop_back();
}

}  // namespace grove::objects::lightfield
