#include "objects/mesh/mesh_backend.h"

#include <algorithm>
#include <latch>
#include <utility>

#include "objects/mesh/embree_mesh_renderer.h"
#include "objects/mesh/gl_mesh_renderer.h"
#include "objects/mesh/light_bake.h"

namespace grove::objects::mesh {
namespace {

const MeshModel& modelOf(const world::Object& object) { return static_cast<const MeshModel&>(*object.model); }

bool anyDrawnByGl(const world::World& world, world::TypeIndex self) {
  return std::ranges::any_of(world.objects(), [&](const world::Object& object) {
    return object.type == self && modelOf(object).renderer() == RendererKind::kGl;
  });
}

}  // namespace

MeshBackend::Entry::Entry(const world::Object& object)
    : lit{modelOf(object).surface(), {}, true},
      points(lit.surface),
      toWorld(object.transform.matrix()),
      renderer(modelOf(object).renderer()) {}

MeshBackend::MeshBackend(const node::BackendServices& services, world::TypeIndex self)
    : executor_(anyDrawnByGl(services.world, self) ? static_cast<pipeline::Executor&>(services.gl) : services.workers) {
  for (const world::Object& object : services.world.objects()) {
    if (object.type != self) continue;
    const Entry& entry = entries_.try_emplace(object.id, object).first->second;
    std::unique_ptr<MeshRenderer>& renderer = renderers_[entry.renderer];
    if (renderer) continue;
    if (entry.renderer == RendererKind::kGl) {
      renderer = std::make_unique<GlMeshRenderer>(services.gl, services.images);
    } else {
      renderer = std::make_unique<EmbreeMeshRenderer>(services.images);
    }
  }
  std::latch left(static_cast<std::ptrdiff_t>(entries_.size()));
  for (auto& [id, entry] : entries_) {
    services.workers.post([&rays = services.world.rays(), &left, &lit = entry.lit, &toWorld = entry.toWorld] {
      lit.light = bakeLight(lit.surface, toWorld, rays);
      left.count_down();
    });
  }
  left.wait();
  if (services.progress) services.progress("light of the meshes", 1.0F);
}

MeshBackend::~MeshBackend() = default;

void MeshBackend::answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) {
  for (const auto& [kind, renderer] : renderers_) answerWith(kind, requests, payloads);
}

void MeshBackend::answerWith(RendererKind kind, std::span<const node::Request> requests,
                             std::span<node::Payload> payloads) {
  std::vector<Drawing> drawings;
  std::vector<std::size_t> slots;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const node::VisibleObject& visible = requests[i].visible();
    const auto it = entries_.find(visible.object.id);
    if (it == entries_.end()) {
      payloads[i] = node::Failure{"no such mesh: " + visible.object.name};
      continue;
    }
    const Entry& entry = it->second;
    if (entry.renderer != kind) continue;
    Drawing& drawing = drawings.emplace_back();
    drawing.object = &entry.lit;
    drawing.camera = &requests[i].view().camera;
    drawing.rect = screenBox(entry.points, entry.toWorld, *drawing.camera, visible.rect);
    drawing.distance = visible.distance / visible.object.transform.scale;
    drawing.bones[0] = entry.toWorld;
    drawing.lamps = chooseLamps(requests[i].view().lights, visible.object.bounds);
    slots.push_back(i);
  }
  std::vector<std::shared_ptr<const node::Image>> images(drawings.size());
  renderers_.at(kind)->render(drawings, images);
  for (std::size_t i = 0; i < slots.size(); ++i) payloads[slots[i]] = std::move(images[i]);
}

}  // namespace grove::objects::mesh
