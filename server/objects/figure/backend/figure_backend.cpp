#include "objects/figure/backend/figure_backend.h"

#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "gl/renderer_choice.h"
#include "objects/figure/backend/contact_shadow.h"
#include "objects/figure/backend/gait.h"
#include "objects/figure/common/stature.h"
#include "raster/shading/light_bake.h"

namespace grove::objects::figure {
namespace {

constexpr float kChestHeight = 1.2F;

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
      executor_(raster::executorFor(gl::resolved(kind, services.gl), services.gl, services.workers)),
      figures_(makeFigures()),
      own_(makeOwnFigure()),
      renderer_(raster::makeRenderer(gl::resolved(kind, services.gl), services.gl, services.images,
                                     {services.memory, "figure"})),
      held_(services.memory, "surfaces", "figure", pipeline::Work::kAcrossUser, bytesOf(figures_) + own_.bytes()) {}

void FigureBackend::answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) {
  std::vector<raster::Drawing> drawings;
  std::vector<std::size_t> slots;
  std::vector<world::Vec3> places;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const node::Request& request = requests[i];
    if (request.shared) {
      payloads[i] = node::Failure{"figures return only pictures"};
      continue;
    }
    payloads[i] = std::shared_ptr<const raster::Image>();
    if (!request.player) continue;
    const auto object = layout_.objectOf(*request.player);
    if (!object || object->id != request.object) continue;
    drawings.push_back(drawingOf(request, *request.player, *object));
    places.push_back(object->transform.position);
    slots.push_back(i);
  }
  std::vector<std::shared_ptr<raster::Image>> images(drawings.size());
  renderer_->render(drawings, images);
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (images[i]) layContactShadow(places[i], *drawings[i].camera, *images[i]);
    payloads[slots[i]] = std::shared_ptr<const raster::Image>(std::move(images[i]));
  }
}

raster::Drawing FigureBackend::drawingOf(const node::Request& request, const world::Player& player,
                                         const world::Object& object) const {
  const node::View& view = *request.view;
  const std::size_t stature = statureOf(player.id);
  world::Transform transform = object.transform;
  const bool isOwn = player.id == view.viewer;
  if (!isOwn) transform.scale *= kStatures[stature].height;
  raster::Drawing drawing;
  drawing.object = isOwn ? &own_ : &figures_[stature];
  drawing.camera = &view.camera;
  drawing.sky = &layout_.sky;
  drawing.rect = request.rect;
  drawing.distance = request.distance / transform.scale;
  drawing.bones = bonesOf(player, transform);
  drawing.tint = linear(player.colour);
  drawing.sunShare =
      raster::sunAt(transform.position + world::Vec3(0.0F, kChestHeight, 0.0F), layout_.sky.sun, geometry_.rays());
  drawing.lamps = raster::chooseLamps(view.lights, object.bounds);
  return drawing;
}

}  // namespace grove::objects::figure
