#include "objects/lightfield/frontend/near_views.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "objects/lightfield/common/permitted_error.h"

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
      if (range.max <= 0.0F) continue;
      const double apart = range.max - range.min;
      sum += apart * apart;
      ++squares;
    }
  }
  return squares > 0 ? static_cast<float>(std::sqrt(sum / squares)) : 0.0F;
}

float reprojectionError(const NearView& view, const ObjectCamera& camera, const world::Rect& rect, float errorPixels) {
  const ObjectCamera& own = view.picture->camera();
  const world::Vec3 moved = camera.eye - own.eye;
  const glm::mat3 toPixels = glm::inverse(glm::mat3(own.perColumn, own.perRow, own.corner));
  const float nearest = view.picture->empty() ? 0.0F : view.picture->range().max;
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

NearView NearViews::last(world::ObjectId object) {
  const std::lock_guard lock(mutex_);
  const NearView* const view = views_.use(object);
  return view == nullptr ? NearView{} : *view;
}

void NearViews::shown(world::ObjectId object, NearView view) {
  std::optional<NearView> replaced;  // their memory is freed after the lock
  std::optional<NearView> oldest;
  const std::lock_guard lock(mutex_);
  bytes_ += bytesOf(view);
  replaced = views_.put(object, std::move(view));
  if (replaced) bytes_ -= bytesOf(*replaced);
  if (views_.size() <= kMax) return;
  oldest = views_.takeOldest().value;
  bytes_ -= bytesOf(*oldest);
}

std::size_t NearViews::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

}  // namespace grove::objects::lightfield
