#include "objects/lightfield/frontend/light_field_frontend.h"

#include <utility>

#include "objects/lightfield/common/keys.h"
#include "objects/lightfield/common/lamps/lamp_light.h"
#include "objects/lightfield/common/object_view.h"
#include "objects/lightfield/frontend/mixed_tiles.h"
#include "objects/lightfield/frontend/reprojection/reprojection.h"

namespace grove::objects::lightfield {
namespace {

/// From this magnification on it is cheaper to sample one pixel per texel and to enlarge the picture here.
constexpr float kMinMagnification = 1.3F;

/// A picture with depth, reprojected to this visitor's eye.
class ReprojectedLayer final : public node::Layer {
 public:
  ReprojectedLayer(const node::VisibleObject& object, const node::View& view, std::shared_ptr<const CachedView> picture,
                   CrossFade fade, bool isFinal, const world::Sky& sky)
      : rect_(object.rect),
        picture_(std::move(picture)),
        fade_(std::move(fade)),
        isFinal_(isFinal),
        camera_(objectCamera(view.camera, object.object.transform)),
        haze_(object.object.bounds, sky, view.camera),
        light_(chooseLamps(view.lights, object.object.bounds, glm::inverse(object.object.transform.matrix())),
               camera_) {}

  [[nodiscard]] bool isFinal() const override { return isFinal_; }

  void lay(node::FrameBuilder& rows) override {
    const world::Rect rect = rows.clip(rect_);
    const auto lay = [&](const world::Rect& part, std::uint32_t* colour, const float* depth) {
      light_.addTo(part, colour, depth, kTileWidth);
      rows.lay(part, colour, depth, kTileWidth);
    };
    const auto hides = [&](const world::Rect& part, float depth) { return rows.hides(part, depth); };
    if (!fade_.from) {
      const auto layTile = [&](const world::Rect& part, WarpTile& tile) { lay(part, tile.colour, tile.depth); };
      reproject(*picture_, camera_, haze_, rect, layTile, hides);
      return;
    }
    MixedTiles tiles(fade_.share);
    const auto addLeaving = [&](const world::Rect& part, const WarpTile& tile) { tiles.addLeaving(part, tile); };
    const auto addComing = [&](const world::Rect& part, const WarpTile& tile) { tiles.addComing(part, tile); };
    reproject(*fade_.from, camera_, haze_, rect, addLeaving, hides);
    reproject(*picture_, camera_, haze_, rect, addComing, hides);
    tiles.forEach(lay);
  }

 private:
  const world::Rect rect_;
  const std::shared_ptr<const CachedView> picture_;
  const CrossFade fade_;
  const bool isFinal_;
  const ObjectCamera camera_;
  const LayeredHaze haze_;
  const LampLight light_;
};

/// Metres. Objects whose bounds are nearer are drawn from their faces: their views would be too coarse, and every step
/// would need new ones.
constexpr float kAmid = 1.0F;

bool isAmid(const Sight& sight) {
  return sight.field.hasNear && sight.object.object.bounds.distance(sight.view.camera.pose.position) <= kAmid;
}

/// Pixels per texel from which on the views, which are blended, look blurred beside the faces.
constexpr float kBlurredTexel = 0.7F;

bool isBlurred(const Sight& sight) {
  return sight.field.hasNear && sight.field.maxError > 0.0F &&
         texelWidth(sight.field.geometry, sight.field.viewSize, sight.camera) > kBlurredTexel;
}

/// Whether a picture is coarse because the budget was spent.
bool isCoarse(const node::Reply& reply) {
  if (reply.ask.key.empty() || reply.ask.key == kNearKey) return false;
  return reply.ask.shared ? cellIdOf(reply.ask.key).coarse : ownPictureOf(reply.ask.key).mustBeMade;
}

}  // namespace

LightFieldFrontend::LightFieldFrontend(const node::FrontendTools& tools, std::shared_ptr<RecentCells> recent)
    : timeline_(tools.timeline), sky_(tools.sky), shared_(tools.timeline, std::move(recent)), own_(tools.timeline) {}

node::Plan LightFieldFrontend::plan(const node::VisibleObject& object, const node::View& view,
                                    const node::SharedOf& shared, const node::Reply* reply) {
  const auto info = std::static_pointer_cast<const FieldInfo>(shared.find({}));
  const bool isOfInfo = reply != nullptr && reply->ask.shared && reply->ask.key.empty();
  if (!info && isOfInfo) return reply->payload;
  if (!info) return node::Ask{.shared = true, .key = {}, .rect = {}};
  rest_.see(view);
  const Sight sight = sightOf(object, view, shared, *info);
  node::Plan plan = reply == nullptr || isOfInfo ? begin(sight) : resume(sight, *reply);
  if (!std::holds_alternative<node::Payload>(plan)) return plan;
  const bool isUnfinished = reply != nullptr && !isOfInfo && (isNotNow(reply->payload) || isCoarse(*reply));
  const bool becomesSharp = isBlurred(sight) && !isAmid(sight) && !own_.isSharp(sight);
  remember(object.object.id, isUnfinished || becomesSharp);
  return plan;
}

node::Plan LightFieldFrontend::begin(const Sight& sight) {
  if (isAmid(sight)) return node::Ask{.shared = false, .key = kNearKey, .rect = sight.object.rect};
  if (isBlurred(sight)) {
    if (own_.isSharp(sight)) return own_.begin(sight, 1.0F);
    if (rest_.isAtRest()) return own_.sharpen(sight);
  }
  return beginFromViews(sight);
}

node::Plan LightFieldFrontend::beginFromViews(const Sight& sight) {
  if (const auto cell = SharedViews::cellOf(sight)) return shared_.begin(sight, *cell);
  if (sight.field.maxError > 0.0F) timeline_.count("views too near to share");
  const float times = magnification(sight.field.geometry, sight.field.viewSize, sight.camera);
  if (times > kMinMagnification || own_.isFading(sight)) return own_.begin(sight, times);
  return node::Ask{.shared = false, .key = {}, .rect = sight.object.rect};
}

node::Plan LightFieldFrontend::resume(const Sight& sight, const node::Reply& reply) {
  if (reply.ask.shared) return shared_.resume(sight, reply);
  if (reply.ask.key.empty() || reply.ask.key == kNearKey) return reply.payload;
  const bool isRefused = isNotNow(reply.payload) && ownPictureOf(reply.ask.key).faces;
  return isRefused ? beginFromViews(sight) : own_.resume(sight, reply);
}

void LightFieldFrontend::remember(world::ObjectId object, bool isProvisional) {
  const std::lock_guard lock(mutex_);
  if (isProvisional) {
    provisional_.insert(object);
  } else {
    provisional_.erase(object);
  }
}

bool LightFieldFrontend::isProvisional(world::ObjectId object) const {
  const std::lock_guard lock(mutex_);
  return provisional_.contains(object);
}

std::unique_ptr<node::Layer> LightFieldFrontend::layer(const node::VisibleObject& object, const node::Payload& payload,
                                                       const node::View& view) {
  const auto* const data = std::get_if<std::shared_ptr<const node::SharedData>>(&payload);
  if (data == nullptr || *data == nullptr) return nullptr;
  auto picture = std::static_pointer_cast<const CachedView>(*data);
  CrossFade fade = this->fade(object.object.id, *picture, view.time);
  const bool isFinal = !fade.from && !isProvisional(object.object.id);
  return std::make_unique<ReprojectedLayer>(object, view, std::move(picture), std::move(fade), isFinal, sky_);
}

CrossFade LightFieldFrontend::fade(world::ObjectId object, const CachedView& picture, double time) {
  CrossFade own = own_.fade(object, picture, time);
  return own.from ? own : shared_.fade(object, time);
}

}  // namespace grove::objects::lightfield
