#include "node/local/local_instance.h"

#include <set>
#include <utility>

#include "node/backend/prepare/share_of_scene.h"

namespace grove::node {
namespace {

LoadedScene ownOf(const LocalInstance::Ground& ground) {
  if (ground.others == nullptr) return ground.scene;
  return shareOf(ground.scene, restOf(ground.scene.layout, ground.others->served()));
}

FrontendEnd& endOf(const LocalInstance::Ground& ground, const std::shared_ptr<Transport>& transport) {
  if (ground.others == nullptr) return *transport;
  ground.others->add("this process", transport);
  return *ground.others;
}

}  // namespace

LocalInstance::LocalInstance(const Ground& ground, std::shared_ptr<Transport> transport, Parallelism parallelism,
                             const BackendNode::Progress& progress)
    : ground_(ground),
      transport_(std::move(transport)),
      end_(endOf(ground_, transport_)),
      own_(ownOf(ground_)),
      backend_(own_, ground_.geometry, ground_.geometry.obstacles(), ground_.types, ground_.machine, parallelism,
               progress),
      served_(backend_.accept(transport_)) {
  reportModels();
}

void LocalInstance::reportModels() {
  std::map<world::TypeIndex, std::set<const world::Model*>> models;
  for (const world::ModelledObject& object : ground_.scene.objects) models[object.type].insert(object.model.get());
  for (const auto& [type, distinct] : models) {
    std::size_t bytes = 0;
    for (const world::Model* model : distinct) bytes += model->bytes();
    const std::string_view name = ground_.types.find(ground_.scene.layout.types[type])->name();
    models_.try_emplace(type, ground_.machine.memory, "models", name, pipeline::Work::kAcrossUser)
        .first->second.set(bytes);
  }
}

}  // namespace grove::node
