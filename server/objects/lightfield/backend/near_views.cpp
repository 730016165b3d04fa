#include "objects/lightfield/backend/near_views.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grove::objects::lightfield {

namespace {

std::size_t bytesOf(const NearView& view) { return view.picture->bytes() + (view.from ? view.from->bytes() : 0); }

}  // namespace

float roughness(const CachedView& picture) {
  double sum = 0.0;
  int squares = 0;
  for (int row = 0; row < picture.squaresDown(); ++row) {
    for (int column = 0; column < picture.squaresAcross(); ++column) {
      const CachedView::Range& range = picture.range(column, row);
      if (range.greatest <= 0.0F) continue;
      const double apart = range.greatest - range.least;
      sum += apart * apart;
      ++squares;
    }
  }
  return squares > 0 ? static_cast<float>(std::sqrt(sum / squares)) : 0.0F;
}

float wrongness(const NearView& view, const ObjectCamera& camera, const world::Rect& rect, float errorPixels) {
  const ObjectCamera& own = view.picture->camera();
  const world::Vec3 moved = camera.eye - own.eye;
  constexpr float kNever = std::numeric_limits<float>::infinity();
  const glm::mat3 toPixels = glm::inverse(glm::mat3(own.perColumn, own.perRow, own.corner));
  const float nearest = view.picture->empty() ? 0.0F : view.picture->range().greatest;
  for (const int x : {rect.left, rect.right}) {
    for (const int y : {rect.top, rect.bottom}) {
      for (const float nearness : {0.0F, nearest}) {
        const world::Vec3 at = toPixels * (camera.ray(static_cast<float>(x), static_cast<float>(y)) + nearness * moved);
        if (!(at.z > 0.0F)) return kNever;
        const bool within = at.x >= static_cast<float>(view.sampled.left) * at.z &&
                            at.x <= static_cast<float>(view.sampled.right) * at.z &&
                            at.y >= static_cast<float>(view.sampled.top) * at.z &&
                            at.y <= static_cast<float>(view.sampled.bottom) * at.z;
        if (!within) return kNever;
      }
    }
  }
  return glm::length(moved) * view.roughness / (errorPixels * glm::length(camera.perColumn));
}

NearView unlessFaded(NearView view, double now) {
  if (now - view.since >= CrossFade::kSeconds) view.from = nullptr;
  return view;
}

std::list<NearViews::Entry>::iterator NearViews::find(node::SessionId session, world::ObjectId object) {
  return std::ranges::find_if(entries_,
                              [&](const Entry& entry) { return entry.session == session && entry.object == object; });
}

NearView NearViews::last(node::SessionId session, world::ObjectId object) {
  const std::lock_guard lock(mutex_);
  const auto entry = find(session, object);
  if (entry == entries_.end()) return {};
  entries_.splice(entries_.begin(), entries_, entry);
  return entry->view;
}

bool NearViews::isFading(const node::View& view, world::ObjectId object, int version) {
  const NearView last = this->last(view.session, object);
  return last.picture && (last.version != version || unlessFaded(last, view.time).from);
}

void NearViews::shown(node::SessionId session, world::ObjectId object, const NearView& view) {
  std::list<Entry> given;  // up: their memory is freed after the lock
  const std::lock_guard lock(mutex_);
  if (const auto entry = find(session, object); entry != entries_.end()) given.splice(given.end(), entries_, entry);
  entries_.push_front({session, object, view});
  if (entries_.size() > kMost) given.splice(given.end(), entries_, std::prev(entries_.end()));
  tell(bytesOf(view), given);
}

void NearViews::forget(node::SessionId session) {
  std::list<Entry> given;
  const std::lock_guard lock(mutex_);
  for (auto next = entries_.begin(); next != entries_.end();) {
    const auto entry = next++;
    if (entry->session == session) given.splice(given.end(), entries_, entry);
  }
  tell(0, given);
}

void NearViews::tell(std::size_t more, const std::list<Entry>& given) {
  bytes_ += more;
  for (const Entry& entry : given) bytes_ -= bytesOf(entry.view);
  held_.set(bytes_);
}

}  // namespace grove::objects::lightfield
