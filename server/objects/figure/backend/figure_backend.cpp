#include "objects/figure/backend/figure_backend.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "gl/renderer_choice.h"
#include "node/load_shedding.h"
#include "objects/figure/backend/gait.h"
#include "objects/figure/backend/shadow/shadow_layer.h"
#include "objects/figure/common/stature.h"
#include "raster/shading/light_bake.h"

namespace grove::objects::figure {
namespace {

constexpr float kChestHeight = 1.2F;
/// Metres above the ground up to which visitors see their own figure.
constexpr float kOwnHeight = 0.5F;
/// The error factor from which shadows move in coarser steps: that of the steps.
constexpr float kCoarseShadows = ShadowPose::kCoarser;

/// Converts a display colour 0x00BBGGRR to linear light.
world::Vec3 linear(std::uint32_t colour) {
  const auto channel = [&](unsigned shift) {
    return std::pow(static_cast<float>((colour >> shift) & 0xFFU) / 255.0F, 2.2F);
  };
  return {channel(0), channel(8), channel(16)};
}

std::vector<raster::LitSurface> makeFigures() {
  std::vector<raster::LitSurface> figures;
  figures.reserve(kStatures.size());
  for (const Stature& stature : kStatures) figures.push_back(makeFigure(stature.breadth));
  return figures;
}

std::size_t bytesOf(const std::vector<raster::LitSurface>& figures) {
  return std::transform_reduce(figures.begin(), figures.end(), std::size_t{0}, std::plus(),
                               [](const raster::LitSurface& figure) { return figure.bytes(); });
}

}  // namespace

FigureBackend::FigureBackend(const node::BackendServices& services, raster::RendererKind kind)
    : layout_(services.scene.layout),
      geometry_(services.geometry),
      workers_(services.workers),
      executor_(raster::executorFor(gl::resolved(kind, services.gl), services.gl, services.workers)),
      figures_(makeFigures()),
      own_(makeOwnFigure()),
      masks_(figures_, layout_.visitor ? layout_.visitor->object.transform.scale : 1.0F, layout_.sky.sun,
             services.memory),
      sun_(layout_.radius + world::kLongestShadow, layout_.sky.sun, layout_.hills, geometry_.rays(), services.memory),
      renderer_(raster::makeRenderer(gl::resolved(kind, services.gl), services.gl, services.images,
                                     {services.memory, "figure"})),
      held_(services.memory, "surfaces", "figure", pipeline::Work::kAcrossUser, bytesOf(figures_) + own_.bytes()) {}

void FigureBackend::answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) {
  std::vector<Figure> figures;
  std::vector<raster::Drawing> drawings;
  std::vector<std::size_t> slots;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    if (requests[i].shared) {
      payloads[i] = node::Failure{"figures return only pictures"};
      continue;
    }
    payloads[i] = std::shared_ptr<const raster::Image>();
    std::optional<Figure> figure = figureOf(requests[i]);
    if (!figure) continue;
    drawings.push_back(figure->drawing);
    figures.push_back(std::move(*figure));
    slots.push_back(i);
  }
  std::vector<std::shared_ptr<raster::Image>> images(drawings.size());
  renderer_->render(drawings, images);
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (images[i]) layShadows(figures[i].place, figures[i].shadow, *drawings[i].camera, *images[i]);
    payloads[slots[i]] = std::shared_ptr<const raster::Image>(std::move(images[i]));
  }
}

std::optional<FigureBackend::Figure> FigureBackend::figureOf(const node::Request& request) {
  if (!request.player) return std::nullopt;
  const world::Player& player = *request.player;
  const auto object = layout_.objectOf(player);
  if (!object || object->id != request.object) return std::nullopt;
  const node::View& view = *request.view;
  const std::size_t stature = statureOf(player.id);
  world::Transform transform = object->transform;
  const bool isOwn = player.id == view.viewer;
  if (!isOwn) transform.scale *= kStatures[stature].height;
  // The object's own bounds and distance include its shadow.
  world::Bounds body = transform.apply(layout_.visitor->bounds);
  if (isOwn) body.high.y = transform.position.y + kOwnHeight;
  Figure figure{{}, transform.position, shadowOf(player, transform.position, view.camera)};
  raster::Drawing& drawing = figure.drawing;
  drawing.object = isOwn ? &own_ : &figures_[stature];
  drawing.camera = &view.camera;
  drawing.sky = &layout_.sky;
  drawing.rect = world::overlap(request.rect, rectOf(body, figure.shadow, view.camera));
  // A busy machine draws coarser figures: doubled errors at most.
  drawing.distance = std::sqrt(node::errorFactor(workers_.busyShare())) *
                     glm::distance(body.centre(), view.camera.pose.position) / transform.scale;
  std::ranges::copy(bonesOf(player, transform), drawing.bones.begin());
  drawing.tint = linear(player.colour);
  drawing.sunShare =
      raster::sunAt(transform.position + world::Vec3(0.0F, kChestHeight, 0.0F), layout_.sky.sun, geometry_.rays());
  drawing.lamps = raster::chooseLamps(view.lights, body);
  return figure;
}

std::optional<SunShadow> FigureBackend::shadowOf(const world::Player& player, world::Vec3 place,
                                                 const world::Camera& camera) {
  const bool isSunUp = layout_.sky.sun.y > SunShadow::kLowestSun;
  if (!isSunUp || glm::distance(place, camera.pose.position) > SunShadow::kFarthest) return std::nullopt;
  const bool isBusy = node::errorFactor(workers_.busyShare()) >= kCoarseShadows;
  const ShadowPose::Steps steps = isBusy ? ShadowPose::Steps::kCoarse : ShadowPose::Steps::kFine;
  return std::optional<SunShadow>(std::in_place, place, *masks_.of(ShadowPose::of(player, steps)), masks_.sun(), sun_,
                                  layout_.sky, camera);
}

}  // namespace grove::objects::figure
