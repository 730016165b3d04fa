#include "node/frontend/backdrops/backdrop_planner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "node/frontend/backdrops/backdrop_area.h"
#include "node/frontend/backdrops/warp_error.h"
#include "node/frontend/scene_analyzer.h"
#include "node/load_shedding.h"

namespace grove::node {
namespace {

/// Frames that a border is drawn for: the first that is not too wide.
constexpr std::array<float, 2> kFramesAhead{2.0F, 1.0F};
/// Metres, while there is time, and down to 0 at the largest error factor. Still objects nearer than this are drawn in
/// every frame: they hide and reveal much of what is behind them.
constexpr float kMinDistance = 2.0F;
/// Metres. The border holds what is at least so far away.
constexpr float kNearestInBorder = 3.0F;
/// Pixels at the frame's edges, times the error factor, that the backdrop may lack while the eye moves; its outermost
/// pixels are repeated there, which whoever stands still would see.
constexpr float kMaxLacking = 8.0F;
/// Seconds. Data that gets finer shows with this delay to a visitor who stands still.
constexpr double kMaxAge = 0.5;
/// Frames that draw everything after a backdrop that no other frame could show, while there is time.
constexpr int kPauseFrames = 2;

/// The same camera with so many pixels more on each side.
world::Camera withMargin(world::Camera camera, int across, int down) {
  const int height = camera.height + 2 * down;
  const float growth = static_cast<float>(height) / static_cast<float>(camera.height);
  camera.verticalFov = 2.0F * std::atan(camera.tanHalfY() * growth);
  camera.width += 2 * across;
  camera.height = height;
  return camera;
}

bool isSameSize(const world::Camera& a, const world::Camera& b) {
  return a.width == b.width && a.height == b.height && a.verticalFov == b.verticalFov;
}

}  // namespace

BackdropPlanner::BackdropPlanner(const world::Layout& layout, std::shared_ptr<VisitorHalves> halves,
                                 std::shared_ptr<BackdropStore> backdrops, ErrorFactor errorFactor)
    : layout_(layout),
      halves_(std::move(halves)),
      backdrops_(std::move(backdrops)),
      currentFactor_(std::move(errorFactor)) {}

std::shared_ptr<const FrameList> BackdropPlanner::plan(std::shared_ptr<const FrameList> seen) {
  const View& view = *seen->view;
  motion_.see(view.camera, view.time);
  errorFactor_ = currentFactor_();
  if (last_ && serves(view)) return listToWarp(*seen);
  const bool servedNone = last_ && view.frame == last_->view->frame + 1;
  last_ = nullptr;
  if (servedNone && errorFactor_ <= 1.0F) pause_ = kPauseFrames;
  const auto isStillHere = [&](const VisibleObject& object) { return isStill(object, view.camera.pose.position); };
  if (pause_ > 0 || std::ranges::none_of(seen->objects, isStillHere)) {
    pause_ = std::max(pause_ - 1, 0);
    return seen;
  }
  last_ = listToDraw(seen->view);
  return last_;
}

void BackdropPlanner::drop(FrameNumber frame) {
  if (last_ && last_->view->frame == frame) last_ = nullptr;
}

std::shared_ptr<const FrameList> BackdropPlanner::listToWarp(const FrameList& seen) const {
  auto list = std::make_shared<FrameList>();
  list->view = seen.view;
  list->backdrop = last_->backdrop;
  std::ranges::copy_if(seen.objects, std::back_inserter(list->objects),
                       [&](const VisibleObject& object) { return !isInLast(object.object.id); });
  return list;
}

std::shared_ptr<const FrameList> BackdropPlanner::listToDraw(const std::shared_ptr<const View>& view) const {
  auto list = std::make_shared<FrameList>();
  list->view = view;
  list->backdrop = view->frame;
  list->area = areaFor(view->camera);
  list->objects = objectsWithin(*view, list->area);
  return list;
}

bool BackdropPlanner::serves(const View& view) const {
  const View& own = *last_->view;
  const double age = view.time - own.time;
  if (!(age >= 0.0 && age <= kMaxAge) || !isSameSize(own.camera, view.camera) || !reaches(view.camera)) return false;
  const auto backdrop = backdrops_->newest();
  // One that is still being drawn has no known error: it serves the next frame only.
  if (!backdrop || backdrop->view().frame != own.frame) return view.frame == own.frame + 1;
  // On a busy machine a backdrop serves some frames whatever its error: amid leaves each frame would draw one.
  if (static_cast<float>(view.frame - own.frame) < errorFactor_) return true;
  return warpError(*backdrop, view.camera) <= errorFactor_ && lightError(own, view) <= errorFactor_;
}

bool BackdropPlanner::reaches(const world::Camera& camera) const {
  const world::Rect part = seenPart(last_->view->camera, camera, kNearestInBorder);
  const world::Rect& area = last_->area;
  const int lacking = motion_.isAtRest() ? 0 : static_cast<int>(kMaxLacking * errorFactor_);
  return !part.empty() && part.left >= area.left - lacking && part.top >= area.top - lacking &&
         part.right <= area.right + lacking && part.bottom <= area.bottom + lacking;
}

world::Rect BackdropPlanner::areaFor(const world::Camera& camera) const {
  for (const float frames : kFramesAhead) {
    const world::Camera later = motion_.ahead(camera, frames * motion_.secondsPerFrame());
    if (const auto area = areaWithBorder(camera, later, kNearestInBorder)) return *area;
  }
  return evenFrame(camera);
}

std::vector<VisibleObject> BackdropPlanner::objectsWithin(const View& view, const world::Rect& area) const {
  const world::Camera& camera = view.camera;
  const int across = std::max({-area.left, area.right - camera.width, 0});
  const int down = std::max({-area.top, area.bottom - camera.height, 0});
  View wide = view;
  wide.camera = withMargin(camera, across, down);
  std::vector<VisibleObject> objects = visibleObjects(layout_, wide);
  const world::Rect frame{0, 0, camera.width, camera.height};
  for (VisibleObject& object : objects) {
    object.still = isStill(object, camera.pose.position);
    object.rect = world::overlap(object.rect.moved(-across, -down), object.still ? area : frame);
  }
  std::erase_if(objects, [](const VisibleObject& object) { return object.rect.empty(); });
  return objects;
}

bool BackdropPlanner::isStill(const VisibleObject& object, world::Vec3 eye) const {
  const float shed = (errorFactor_ - 1.0F) / (kMaxErrorFactor - 1.0F);
  const std::optional<float> distance = halves_->of(object.object.type).stillDistance(object, eye);
  return distance && *distance >= kMinDistance * (1.0F - shed);
}

bool BackdropPlanner::isInLast(world::ObjectId id) const {
  return std::ranges::any_of(last_->objects,
                             [&](const VisibleObject& object) { return object.still && object.object.id == id; });
}

}  // namespace grove::node
