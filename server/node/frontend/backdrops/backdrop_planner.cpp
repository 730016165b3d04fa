#include "node/frontend/backdrops/backdrop_planner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "node/frontend/backdrops/backdrop_area.h"
#include "node/frontend/backdrops/light_error.h"
#include "node/frontend/backdrops/warp_error.h"
#include "node/frontend/scene_analyzer.h"
#include "node/limits.h"
#include "node/load_shedding.h"

namespace grove::node {
namespace {

/// Frames for which a border is drawn: the first value whose border is not too wide.
constexpr std::array<float, 2> kFramesAhead{2.0F, 1.0F};
/// Metres; decreases to 0 at the largest error factor. Nearer still objects are drawn in every frame, because they hide
/// and reveal much of the background.
constexpr float kMinDistance = 2.0F;
/// Metres. The border contains everything at this distance or beyond.
constexpr float kNearestInBorder = 3.0F;
/// Pixels at the frame's edges, times the error factor, that may be missing while the eye moves. The outermost pixels
/// are repeated there, which is visible when the eye stands still.
constexpr float kMaxLacking = 8.0F;
/// Seconds for which a backdrop serves whatever its error, per error factor beyond 1. Otherwise each frame of a busy
/// machine would draw a new one amid leaves.
constexpr float kMinSeconds = 0.1F;
/// Factor for those seconds while it is other visitors' turn.
constexpr float kWait = 2.0F;
/// Shares of those seconds, and of the permitted error, by which a backdrop's eye is ahead of the visitor's.
constexpr float kLeadShare = 0.4F;
constexpr float kLeadError = 0.7F;
/// Metres. An eye behind the backdrop's eye sees more at the edges, so the border grows with the lead.
constexpr float kMaxLead = 0.4F;
/// In multiples of the permitted error.
constexpr float kMinError = 1.0e-3F;
/// Share of the permitted error up to which a backdrop is extended; above, it will soon be drawn anew.
constexpr float kMaxExtendedError = 0.7F;
/// Seconds. A visitor who stands still sees finer data with this delay.
constexpr double kMaxAge = 0.5;
/// Factor by which frames may be larger or smaller than the backdrop that they show until it is the visitor's turn.
constexpr float kMaxResize = 2.1F;
/// Frames that draw everything after a backdrop that no other frame could show, unless the machine is busy.
constexpr int kPauseFrames = 2;

/// The same camera with more pixels on each side.
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

/// Whether the warp changes sizes by little enough to look like a picture of fewer pixels.
bool isSimilarSize(const world::Camera& a, const world::Camera& b) {
  const float times = a.focal() / b.focal();
  return times < kMaxResize && times > 1.0F / kMaxResize;
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
  if (last_ && serves(view)) {
    if (reaches(view.camera)) return listToWarp(*seen);
    if (auto list = listToExtend(*seen)) {
      adopt(list);
      return list;
    }
  }
  const bool servedNone = last_ && view.frame == last_->view->frame + 1;
  last_ = nullptr;
  if (servedNone && errorFactor_ <= 1.0F) pause_ = kPauseFrames;
  const auto isStillHere = [&](const VisibleObject& object) { return isStill(object, view.camera.pose.position); };
  if (pause_ > 0 || std::ranges::none_of(seen->objects, isStillHere)) {
    pause_ = std::max(pause_ - 1, 0);
    return seen;
  }
  held_.clear();
  adopt(listToDraw(*seen));
  backdrops_->turn().begin();
  return last_;
}

void BackdropPlanner::drop(FrameNumber frame) {
  if (!last_ || last_->view->frame != frame) return;
  last_ = nullptr;
  backdrops_->turn().end();
}

std::shared_ptr<const FrameList> BackdropPlanner::listToWarp(const FrameList& seen) const {
  auto list = std::make_shared<FrameList>();
  list->view = seen.view;
  list->backdrop = last_->backdrop;
  std::ranges::copy_if(seen.objects, std::back_inserter(list->objects),
                       [&](const VisibleObject& object) { return !held_.contains(object.object.id); });
  return list;
}

std::shared_ptr<const FrameList> BackdropPlanner::listToDraw(const FrameList& seen) const {
  auto list = std::make_shared<FrameList>();
  list->view = withBackdropPose(seen.view);
  list->eye = backdropEyeOf(list->view);
  list->backdrop = seen.view->frame;
  list->area = areaFor(list->eye->camera, seen.view->camera);
  list->drawn = {list->area};
  std::set<world::ObjectId> drawn;
  for (VisibleObject& object : objectsAround(*list->eye, list->area)) {
    object.rect = world::overlap(object.rect, list->area);
    const bool isStillForBoth =
        isStill(object, seen.view->camera.pose.position) && isStill(object, list->eye->camera.pose.position);
    if (object.rect.empty() || !isStillForBoth) continue;
    object.still = true;
    drawn.insert(object.object.id);
    list->objects.push_back(object);
  }
  std::ranges::copy_if(seen.objects, std::back_inserter(list->objects),
                       [&](const VisibleObject& object) { return !drawn.contains(object.object.id); });
  // Back to front: skips the farthest.
  const std::size_t tooMany = list->objects.size() - std::min(list->objects.size(), kMaxObjectsPerFrame);
  list->objects.erase(list->objects.begin(), list->objects.begin() + static_cast<std::ptrdiff_t>(tooMany));
  return list;
}

std::shared_ptr<const View> BackdropPlanner::withBackdropPose(const std::shared_ptr<const View>& view) const {
  const world::Vec3 ahead = lead();
  if (ahead == world::Vec3(0.0F)) return view;
  auto posed = std::make_shared<View>(*view);
  posed->backdropPose = view->camera.pose;
  posed->backdropPose->position += ahead;
  return posed;
}

std::shared_ptr<const FrameList> BackdropPlanner::listToExtend(const FrameList& seen) const {
  const auto backdrop = backdrops_->newest();
  const View& view = *seen.view;
  if (!backdrop || backdrop->origin().frame != last_->view->frame) return nullptr;
  const double nextAge = view.time + motion_.secondsPerFrame() - last_->backdropEye()->time;
  const float maxError = kMaxExtendedError * permittedError();
  if (nextAge >= minSeconds() && warpError(*backdrop, view.camera) > maxError) return nullptr;
  const world::Camera& camera = backdrop->view().camera;
  const world::Camera later = motion_.ahead(view.camera, kFramesAhead.front() * motion_.secondsPerFrame());
  const auto area = extendedArea(last_->area, seenPart(camera, view.camera, kNearestInBorder),
                                 seenPart(camera, later, kNearestInBorder), camera);
  if (!area) return nullptr;
  auto list = std::make_shared<FrameList>();
  list->view = seen.view;
  list->backdrop = view.frame;
  list->area = *area;
  list->extended = backdrop->origin().frame;
  list->eye = backdrop->origin().view;
  list->drawn = partsBeyond(*area, last_->area);
  list->objects = objectsBeyond(*list);
  const auto isFresh = [&](const VisibleObject& object) {
    const auto isSame = [&](const VisibleObject& other) { return other.object.id == object.object.id; };
    return !held_.contains(object.object.id) && std::ranges::none_of(list->objects, isSame);
  };
  std::ranges::copy_if(seen.objects, std::back_inserter(list->objects), isFresh);
  return list->objects.size() <= kMaxObjectsPerFrame ? list : nullptr;
}

std::vector<VisibleObject> BackdropPlanner::objectsBeyond(const FrameList& list) const {
  std::vector<VisibleObject> objects;
  for (VisibleObject& object : objectsAround(*list.eye, list.area)) {
    // Objects that were drawn in every frame so far still are, because the backdrop lacks them.
    const bool isHeld = held_.contains(object.object.id) || world::overlap(object.rect, last_->area).empty();
    if (!isHeld || !isStill(object, list.eye->camera.pose.position)) continue;
    object.still = true;
    for (const world::Rect& part : list.drawn) {
      const world::Rect rect = world::overlap(object.rect, part);
      if (rect.empty()) continue;
      objects.push_back(object);
      objects.back().rect = rect;
    }
  }
  return objects;
}

void BackdropPlanner::adopt(std::shared_ptr<const FrameList> list) {
  for (const VisibleObject& object : list->objects) {
    if (object.still) held_.insert(object.object.id);
  }
  last_ = std::move(list);
}

bool BackdropPlanner::serves(const View& view) const {
  const View& eye = *last_->backdropEye();
  const double age = view.time - eye.time;
  const auto backdrop = backdrops_->newest();
  const bool isDrawn = backdrop && backdrop->origin().frame == last_->view->frame;
  const double maxAge = isDrawn && backdrop->origin().isFinal ? kMaxBackdropAge : kMaxAge;
  if (!(age >= 0.0 && age <= maxAge)) return false;
  if (!isSameSize(eye.camera, view.camera)) {
    // Pictures of all visitors change their size at the same time.
    return isDrawn && backdrops_->turn().isOthers() && isSimilarSize(eye.camera, view.camera);
  }
  // A backdrop in progress has no known error: it serves the next frame only.
  if (!isDrawn) return view.frame == last_->view->frame + 1;
  if (age < minSeconds()) return true;
  return warpError(*backdrop, view.camera) <= permittedError() && lightError(*backdrop, view.lights) <= errorFactor_;
}

bool BackdropPlanner::reaches(const world::Camera& camera) const {
  const world::Rect part = seenPart(last_->backdropEye()->camera, camera, kNearestInBorder);
  const world::Rect& area = last_->area;
  const int lacking = motion_.isAtRest() ? 0 : static_cast<int>(kMaxLacking * errorFactor_);
  return !part.empty() && part.left >= area.left - lacking && part.top >= area.top - lacking &&
         part.right <= area.right + lacking && part.bottom <= area.bottom + lacking;
}

world::Vec3 BackdropPlanner::lead() const {
  const auto backdrop = backdrops_->newest();
  if (!backdrop || errorFactor_ <= 1.0F || motion_.isAtRest()) return world::Vec3(0.0F);
  const world::Vec3 perFrame = motion_.secondsPerFrame() * motion_.velocity();
  world::Camera moved = backdrop->view().camera;
  moved.pose.position += perFrame;
  const float error = kLeadError * std::min(errorFactor_ - 1.0F, 1.0F) * permittedError();
  const float frames = error / std::max(warpError(*backdrop, moved), kMinError);
  const float seconds = std::max(frames * motion_.secondsPerFrame(), kLeadShare * minSeconds());
  const world::Vec3 way = seconds * motion_.velocity();
  return way * (kMaxLead / std::max(glm::length(way), kMaxLead));
}

float BackdropPlanner::permittedError() const { return std::sqrt(errorFactor_); }

float BackdropPlanner::minSeconds() const {
  return kMinSeconds * (errorFactor_ - 1.0F) * (backdrops_->turn().isOthers() ? kWait : 1.0F);
}

world::Rect BackdropPlanner::areaFor(const world::Camera& eye, const world::Camera& camera) const {
  const world::Rect seen = seenPart(eye, camera, kNearestInBorder);
  for (const float frames : kFramesAhead) {
    const world::Camera later = motion_.ahead(camera, frames * motion_.secondsPerFrame());
    if (const auto area = areaWithBorder(seen, seenPart(eye, later, kNearestInBorder), eye)) return *area;
  }
  return wholeCells(seen);
}

std::vector<VisibleObject> BackdropPlanner::objectsAround(const View& eye, const world::Rect& area) const {
  const world::Camera& camera = eye.camera;
  const int across = std::max({-area.left, area.right - camera.width, 0});
  const int down = std::max({-area.top, area.bottom - camera.height, 0});
  View wide = eye;
  wide.camera = withMargin(camera, across, down);
  std::vector<VisibleObject> objects = visibleObjects(layout_, wide);
  for (VisibleObject& object : objects) object.rect = object.rect.moved(-across, -down);
  return objects;
}

bool BackdropPlanner::isStill(const VisibleObject& object, world::Vec3 eye) const {
  const float shed = (errorFactor_ - 1.0F) / (kMaxErrorFactor - 1.0F);
  const std::optional<float> distance = halves_->of(object.object.type).stillDistance(object, eye);
  return distance && *distance >= kMinDistance * (1.0F - shed);
}

}  // namespace grove::node
