#include "objects/lightfield/frontend/own_views.h"

#include <algorithm>
#include <utility>

#include "objects/lightfield/common/keys.h"
#include "objects/lightfield/common/permitted_error.h"
#include "objects/lightfield/frontend/near_margins.h"

namespace grove::objects::lightfield {
namespace {

/// Share of the permitted error that a near picture may have. It is less than 1 for two reasons: the error of a near
/// picture is a mean, that of a far one a maximum, and near objects cover more of the screen.
constexpr float kNearShare = 0.15F;

/// `times`: width of a texel, in pixels.
Shot shotOf(const Sight& sight, const NearView& last, float times) {
  const Shot whole{sight.camera, withMargins(sight.object.rect, sight.view.camera, sight.camera, last, times)};
  return whole.coarser(times);
}

/// Error of a picture of views while the eye rests; small, because one of faces takes long and only looks better.
constexpr float kBlurredError = 1.2F;

node::Ask askFor(const Shot& shot, bool mustBeMade, float urgency) {
  return {.shared = false, .key = keyOf(OwnPicture{shot.camera, mustBeMade}), .rect = shot.rect, .urgency = urgency};
}

node::Plan planOf(std::shared_ptr<const CachedView> picture) {
  return node::Payload(std::shared_ptr<const node::SharedData>(std::move(picture)));
}

/// Whether no picture is kept from frame to frame.
bool isForOneFrame(const Sight& sight) { return sight.field.maxError <= 0.0F; }

}  // namespace

float OwnViews::errorOf(const Sight& sight, const NearView& last) const {
  if (!last.picture) return kNever;
  float error = reprojectionError(last, sight.camera, sight.object.rect, kNearShare * sight.field.maxError);
  if (last.coarse) error = std::max(error, kCoarseError);
  if (last.version != sight.field.number) error = std::max(error, kOutdatedError);
  return error;
}

node::Plan OwnViews::begin(const Sight& sight, float times) {
  if (isForOneFrame(sight)) return askFor(shotOf(sight, {}, times), true, kNever);
  const NearView last = near_.last(sight.id());
  const float error = errorOf(sight, last);
  if (error <= 1.0F) return showAgain(sight, last, "near views shown again");
  return askFor(shotOf(sight, last, times), false, error);
}

node::Plan OwnViews::sharpen(const Sight& sight) {
  const Shot shot = shotOf(sight, near_.last(sight.id()), 1.0F);
  return node::Ask{.shared = false,
                   .key = keyOf(OwnPicture{.camera = shot.camera, .faces = true}),
                   .rect = shot.rect,
                   .urgency = kBlurredError};
}

bool OwnViews::isSharp(const Sight& sight) {
  const NearView last = near_.last(sight.id());
  return last.sharp && errorOf(sight, last) <= 1.0F;
}

node::Plan OwnViews::resume(const Sight& sight, const node::Reply& reply) {
  const OwnPicture asked = ownPictureOf(reply.ask.key);
  const NearView last = isForOneFrame(sight) ? NearView{} : near_.last(sight.id());
  if (isNotNow(reply.payload) && !asked.mustBeMade) {
    if (errorOf(sight, last) < kNever) return showAgain(sight, last, "near views shown stale");
    return askFor(Shot{asked.camera, reply.ask.rect}.coarser(kCoarse), true, kNever);
  }
  const auto* const image = std::get_if<std::shared_ptr<const raster::Image>>(&reply.payload);
  if (image == nullptr || *image == nullptr) return reply.payload;
  auto picture = std::make_shared<const CachedView>(**image, asked.camera);
  if (isForOneFrame(sight)) return planOf(std::move(picture));
  if (asked.mustBeMade) timeline_.count("coarse views");
  if (asked.faces) timeline_.count("sharp views");
  const bool isOutdated = last.picture && last.version != sight.field.number;
  NearView next =
      isOutdated ? NearView{.from = last.picture, .since = sight.view.time} : unlessFaded(last, sight.view.time);
  next.picture = picture;
  next.sampled = reply.ask.rect;
  next.roughness = roughness(*picture);
  next.edges = edgeNearness(*picture, reply.ask.rect);
  next.coarse = asked.mustBeMade;
  next.sharp = asked.faces;
  next.version = sight.field.number;
  near_.shown(sight.id(), std::move(next));
  return planOf(std::move(picture));
}

node::Plan OwnViews::showAgain(const Sight& sight, const NearView& last, const char* counter) {
  timeline_.count(counter);
  NearView again = unlessFaded(last, sight.view.time);
  if (again.from != last.from) near_.shown(sight.id(), std::move(again));
  return planOf(last.picture);
}

bool OwnViews::isFading(const Sight& sight) {
  const NearView last = near_.last(sight.id());
  return last.picture && (last.version != sight.field.number || unlessFaded(last, sight.view.time).from);
}

CrossFade OwnViews::fade(world::ObjectId object, const CachedView& picture, double time) {
  const NearView last = near_.last(object);
  if (last.picture.get() != &picture || !last.from) return {};
  return {last.from, CrossFade::shareAfter(time - last.since)};
}

}  // namespace grove::objects::lightfield
