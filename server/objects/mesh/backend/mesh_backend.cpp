#include "objects/mesh/backend/mesh_backend.h"

#include <algorithm>
#include <utility>

#include "gl/renderer_choice.h"
#include "node/backend/drawing_executor.h"
#include "objects/mesh/backend/lighting/mesh_light.h"

namespace grove::objects::mesh {
namespace {

const MeshModel& modelOf(const world::ModelledObject& object) { return static_cast<const MeshModel&>(*object.model); }

raster::RendererKind kindOf(const world::ModelledObject& object, const gl::Workers& gl) {
  return gl::resolved(modelOf(object).renderer(), gl);
}

}  // namespace

MeshBackend::Entry::Entry(const world::ModelledObject& object, raster::RendererKind kind)
    : lit{modelOf(object).surface(), {}, true},
      points(lit.surface),
      toWorld(object.transform.matrix()),
      bounds(object.bounds),
      scale(object.transform.scale),
      renderer(kind) {}

MeshBackend::MeshBackend(const node::BackendServices& services, world::TypeIndex self)
    : sky_(services.scene.layout.sky),
      executor_(node::drawingExecutor(services, self,
                                      [&](const world::ModelledObject& object) {
                                        return kindOf(object, services.gl) == raster::RendererKind::kGl;
                                      })),
      held_(services.memory, "surfaces", "mesh", pipeline::Work::kAcrossUser) {
  for (const world::ModelledObject& object : services.scene.objects) {
    if (object.type != self) continue;
    const raster::RendererKind kind = kindOf(object, services.gl);
    entries_.try_emplace(object.id, object, kind);
    std::unique_ptr<raster::MeshRenderer>& renderer = renderers_[kind];
    if (!renderer) renderer = raster::makeRenderer(kind, services.gl, services.images, {services.memory, "mesh"});
  }
  std::vector<PlacedMesh> meshes;
  std::vector<std::vector<world::Vec4>*> lights;
  for (const world::ModelledObject& object : services.scene.objects) {
    if (object.type != self) continue;
    Entry& entry = entries_.at(object.id);
    meshes.push_back({&entry.lit.surface, entry.toWorld, modelOf(object).shade() != nullptr});
    lights.push_back(&entry.lit.light);
  }
  auto light = lightOf(meshes, services);
  for (std::size_t i = 0; i < lights.size(); ++i) *lights[i] = std::move(light[i]);
  std::size_t bytes = 0;
  for (const auto& [id, entry] : entries_) bytes += entry.lit.bytes() + entry.points.bytes();
  held_.set(bytes);
}

MeshBackend::~MeshBackend() = default;

void MeshBackend::answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) {
  for (const auto& [kind, renderer] : renderers_) answerWith(kind, requests, payloads);
}

void MeshBackend::answerWith(raster::RendererKind kind, std::span<const node::Request> requests,
                             std::span<node::Payload> payloads) {
  std::vector<raster::Drawing> drawings;
  std::vector<std::size_t> slots;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const node::Request& request = requests[i];
    const auto it = entries_.find(request.object);
    if (it == entries_.end() || request.shared) {
      payloads[i] = node::Failure{"meshes return only pictures of meshes"};
      continue;
    }
    const Entry& entry = it->second;
    if (entry.renderer != kind) continue;
    raster::Drawing& drawing = drawings.emplace_back();
    drawing.object = &entry.lit;
    drawing.camera = &request.seenBy().camera;
    drawing.sky = &sky_;
    drawing.rect = raster::screenBox(entry.points, entry.toWorld, *drawing.camera, request.rect);
    drawing.distance = request.distance / entry.scale;
    drawing.bones[0] = entry.toWorld;
    drawing.lamps = raster::chooseLamps(request.seenBy().lights, entry.bounds);
    slots.push_back(i);
  }
  std::vector<std::shared_ptr<raster::Image>> images(drawings.size());
  renderers_.at(kind)->render(drawings, images);
  for (std::size_t i = 0; i < slots.size(); ++i) payloads[slots[i]] = std::move(images[i]);
}

}  // namespace grove::objects::mesh
