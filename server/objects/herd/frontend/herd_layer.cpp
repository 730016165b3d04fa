#include "objects/herd/frontend/herd_layer.h"

#include <algorithm>
#include <utility>

#include "objects/herd/common/deer_skeleton.h"
#include "objects/herd/frontend/herd_motion.h"

namespace grove::objects::herd {
namespace {

world::Rect frameOf(const world::Camera& camera) { return {0, 0, camera.width, camera.height}; }

/// Metres by which hooves, ears, muzzle and antlers of an animal of size 1 reach beyond its capsules.
constexpr float kRoom = 0.06F;
constexpr float kRoomAroundHead = 0.26F;

/// Returns the bounds of the body in its pose.
world::Bounds boundsOf(const Capsules& capsules, float size) {
  world::Bounds bounds;
  const auto add = [&](world::Vec3 at, float radius) {
    bounds.add(at - radius);
    bounds.add(at + radius);
  };
  for (const Capsule& each : capsules) {
    add(each.from, each.fromRadius + kRoom * size);
    add(each.to, each.toRadius + kRoom * size);
  }
  add(capsules[kHeadCapsule].from, kRoomAroundHead * size);
  return bounds;
}

}  // namespace

HerdLayer::HerdLayer(HerdPainter& painter, std::shared_ptr<const HerdSnapshot> herd, const world::Sky& sky,
                     const node::View& view)
    : painter_(painter), herd_(std::move(herd)), sky_(sky), view_(view) {
  for (const Animal& animal : herd_->animals()) {
    if (auto each = shown(animal)) shown_.push_back(std::move(*each));
  }
  std::ranges::sort(shown_, {}, &Shown::distance);
}

std::optional<HerdLayer::Shown> HerdLayer::shown(const Animal& animal) const {
  const world::Camera& camera = view_.camera;
  const world::Rect frame = frameOf(camera);
  Shown each{&animal, herd_->poseAt(animal, view_.time), 0.0F, {}, {}, std::nullopt, nullptr};
  each.distance =
      glm::distance(each.pose.place + world::Vec3(0.0F, kTrunkHeight * animal.size, 0.0F), camera.pose.position);
  if (!(each.distance < kFarthest)) return std::nullopt;
  const Capsules capsules = capsulesOf(each.pose, animal.size, animal.kind == Kind::kBuck);
  each.bounds = boundsOf(capsules, animal.size);
  if (camera.sees(each.bounds)) each.rect = camera.screenRect(each.bounds);
  if (each.distance < DeerShadow::kFarthest) {
    each.shadow.emplace(each.pose, animal.size, capsules, animal.sunShare, sky_, camera, frame);
    if (each.shadow->rect().empty()) each.shadow.reset();
  }
  if (each.rect.empty() && !each.shadow) return std::nullopt;
  return each;
}

void HerdLayer::makePart(std::size_t part) {
  Shown& each = shown_[part];
  const Animal& animal = *each.animal;
  raster::Drawing drawing;
  drawing.object = &painter_.surfaceOf(animal.kind);
  drawing.camera = &view_.camera;
  drawing.sky = &sky_;
  drawing.rect = each.rect;
  drawing.distance = painter_.coarseness() * each.distance / animal.size;
  std::ranges::copy(bonesOf(each.pose, animal.size), drawing.bones.begin());
  drawing.sunShare = animal.sunShare;
  drawing.lamps = raster::chooseLamps(view_.lights, each.bounds);
  each.picture = painter_.paint(drawing);
}

void HerdLayer::lay(node::FrameBuilder& rows) {
  for (const Shown& each : shown_) {
    if (each.picture && !rows.clip(each.picture->rect).empty()) rows.lay(*each.picture);
  }
}

void HerdLayer::draw(raster::Image& frame) {
  for (const Shown& each : shown_) {
    if (each.shadow) each.shadow->draw(view_.camera, each.picture.get(), frame);
  }
}

std::optional<node::Mover> HerdLayer::mover() const {
  for (const Shown& each : shown_) {
    if (auto mover = moverOf(*herd_, *each.animal, each.bounds, view_)) return mover;
  }
  return std::nullopt;
}

world::Rect HerdLayer::reach(const world::Rect& /*rect*/) const {
  world::Rect all;
  const auto add = [&](const world::Rect& rect) {
    if (rect.empty()) return;
    all = all.empty() ? rect
                      : world::Rect{std::min(all.left, rect.left), std::min(all.top, rect.top),
                                    std::max(all.right, rect.right), std::max(all.bottom, rect.bottom)};
  };
  for (const Shown& each : shown_) {
    add(each.rect);
    if (each.shadow) add(each.shadow->rect());
  }
  return all;
}

}  // namespace grove::objects::herd
