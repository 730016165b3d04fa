#include "objects/figure/backend/figure_backend.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gl/renderer_choice.h"
#include "objects/figure/backend/gait.h"
#include "raster/shading/light_bake.h"

namespace grove::objects::figure {
namespace {

constexpr float kChestHeight = 1.2F;

/// A display colour 0x00BBGGRR as linear light.
world::Vec3 linear(std::uint32_t colour) {
  const auto channel = [&](unsigned shift) {
    return std::pow(static_cast<float>((colour >> shift) & 0xFFU) / 255.0F, 2.2F);
  };
  return {channel(0), channel(8), channel(16)};
}

}  // namespace

FigureBackend::FigureBackend(const node::BackendServices& services, raster::RendererKind kind)
    : layout_(services.scene.layout),
      geometry_(services.geometry),
      executor_(raster::executorFor(gl::resolved(kind, services.gl), services.gl, services.workers)),
      figure_(makeFigure()),
      renderer_(raster::makeRenderer(gl::resolved(kind, services.gl), services.gl, services.images,
                                     {services.memory, "figure"})),
      held_(services.memory, "surfaces", "figure", pipeline::Work::kAcrossUser, figure_.bytes()) {}

void FigureBackend::answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) {
  std::vector<raster::Drawing> drawings;
  std::vector<std::size_t> slots;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const node::Request& request = requests[i];
    if (request.shared) {
      payloads[i] = node::Failure{"figures answer with pictures"};
      continue;
    }
    const node::View& view = *request.view;
    payloads[i] = std::shared_ptr<const raster::Image>();
    const auto player = std::ranges::find(view.players, request.object - world::kFirstPlayerObject, &world::Player::id);
    if (player == view.players.end()) continue;
    const auto object = layout_.objectOf(*player);
    if (!object) continue;
    const world::Transform& transform = object->transform;
    raster::Drawing& drawing = drawings.emplace_back();
    drawing.object = &figure_;
    drawing.camera = &view.camera;
    drawing.sky = &layout_.sky;
    drawing.rect = request.rect;
    drawing.distance = request.distance / transform.scale;
    drawing.bones = bonesOf(*player, transform);
    drawing.tint = linear(player->colour);
    drawing.sunShare =
        raster::sunAt(transform.position + world::Vec3(0.0F, kChestHeight, 0.0F), layout_.sky.sun, geometry_.rays());
    drawing.lamps = raster::chooseLamps(view.lights, object->bounds);
    slots.push_back(i);
  }
  std::vector<std::shared_ptr<const raster::Image>> images(drawings.size());
  renderer_->render(drawings, images);
  for (std::size_t i = 0; i < slots.size(); ++i) payloads[slots[i]] = std::move(images[i]);
}

}  // namespace grove::objects::figure
