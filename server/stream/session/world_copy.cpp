#include "stream/session/world_copy.h"

#include <future>
#include <set>
#include <utility>

#include "gl/workers.h"

namespace grove::stream {

WorldCopy::WorldCopy(const WorldGround& ground, std::unique_ptr<node::Transport> transport, Haste haste,
                     const std::function<void(std::string_view, float)>& progress)
    : ground_(ground), world_(ground.layout, ground.geometry, ground.players), transport_(std::move(transport)) {
  tellModels();
  const node::BackendServices services{.world = world_,
                                       .workers = ground.workers,
                                       .gl = ground.gl,
                                       .timeline = ground.timeline,
                                       .memory = ground.memory,
                                       .images = ground.images,
                                       .progress = progress,
                                       .helpers = haste == Haste::kAllCores ? &ground_.workers : nullptr,
                                       .baked = ground.baked};
  std::set<world::TypeIndex> types;
  for (const world::Object& object : world_.objects()) types.insert(object.type);
  if (world_.visitor()) types.insert(world_.visitor()->type);
  const auto policy = haste == Haste::kAllCores ? std::launch::async : std::launch::deferred;
  std::vector<std::future<std::unique_ptr<node::BackendNode>>> prepared;
  prepared.reserve(types.size());
  for (const world::TypeIndex type : types) {
    prepared.push_back(std::async(policy, [this, type, services] {
      return std::make_unique<node::BackendNode>(ground_.registry.type(type), type, services, *transport_);
    }));
  }
  for (auto& backend : prepared) backends_.push_back(backend.get());
}

WorldCopy::~WorldCopy() {
  for (const auto& backend : backends_) backend->close();
  // Runs in progress use the backends; with every queue closed, none can start after these.
  ground_.workers.drain();
  ground_.gl.drain();
  ground_.workers.drain();
}

void WorldCopy::tellModels() {
  std::map<world::TypeIndex, std::set<const world::Model*>> models;
  for (const world::Object& object : world_.objects()) models[object.type].insert(object.model.get());
  for (const auto& [type, distinct] : models) {
    std::size_t bytes = 0;
    for (const world::Model* model : distinct) bytes += model->bytes();
    models_.try_emplace(type, ground_.memory, "models", ground_.registry.type(type).name(), pipeline::Work::kAcrossUser)
        .first->second.set(bytes);
  }
}

void WorldCopy::setQuality(int step) {
  for (const auto& backend : backends_) backend->setQuality(step);
}

void WorldCopy::forget(node::SessionId session) {
  for (const auto& backend : backends_) backend->forget(session);
}

node::FrontendServices WorldCopy::frontendServices() {
  return {world_, ground_.registry, *transport_, ground_.workers, ground_.timeline, ground_.memory, ground_.images};
}

}  // namespace grove::stream
