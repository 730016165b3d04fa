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

Sides edgeNearness(const CachedView& picture, const world::Rect& sampled) {
  if (picture.empty()) return {};
  const auto edge = [&](int gap, const world::Rect& squares) {
    if (gap >= kClearTexels) return kObjectEnds;
    float nearest = 0.0F;
    for (int row = squares.top; row < squares.bottom; ++row) {
      for (int column = squares.left; column < squares.right; ++column) {
        nearest = std::max(nearest, picture.range(column, row).max);
      }
    }
    return nearest;
  };
  constexpr int kBorder = CachedView::kBorder;
  const int across = picture.squaresAcross();
  const int down = picture.squaresDown();
  // The last square of a row or column may be one texel wide.
  const int wide = std::min(2, across);
  const int high = std::min(2, down);
  return {edge(picture.left() + kBorder - sampled.left, {0, 0, wide, down}),
          edge(picture.top() + kBorder - sampled.top, {0, 0, across, high}),
          edge(sampled.right - (picture.left() + picture.width() - kBorder), {across - wide, 0, across, down}),
          edge(sampled.bottom - (picture.top() + picture.height() - kBorder), {0, down - high, across, down})};
}

float reprojectionError(const NearView& view, const ObjectCamera& camera, const world::Rect& rect, float errorPixels) {
  const ObjectCamera& own = view.picture->camera();
  const world::Vec3 moved = camera.eye - own.eye;
  const glm::mat3 toPixels = glm::inverse(glm::mat3(own.perColumn, own.perRow, own.corner));
  // Whether the picture contains everything that a pixel may see between `nearness` and infinity.
  const auto within = [&](int x, int y, float nearness, const auto& isInside) {
    const world::Vec3 ray = camera.ray(static_cast<float>(x), static_cast<float>(y));
    const auto inside = [&](float w) {
      const world::Vec3 at = toPixels * (ray + w * moved);
      return at.z > 0.0F && (nearness < 0.0F || isInside(at));
    };
    return inside(0.0F) && inside(std::max(nearness, 0.0F));
  };
  const auto limit = [](int edge, float z) { return static_cast<float>(edge) * z; };
  const world::Rect& sampled = view.sampled;
  for (const int x : {rect.left, rect.right}) {
    for (const int y : {rect.top, rect.bottom}) {
      const Sides& edges = view.edges;
      const bool isShown =
          within(x, y, edges.left, [&](world::Vec3 at) { return at.x >= limit(sampled.left, at.z); }) &&
          within(x, y, edges.right, [&](world::Vec3 at) { return at.x <= limit(sampled.right, at.z); }) &&
          within(x, y, edges.top, [&](world::Vec3 at) { return at.y >= limit(sampled.top, at.z); }) &&
          within(x, y, edges.bottom, [&](world::Vec3 at) { return at.y <= limit(sampled.bottom, at.z); });
      if (!isShown) return kNever;
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
