#include "node/backend/prepare/model_memory.h"

#include <cstddef>
#include <set>

namespace grove::node {

ModelMemory::ModelMemory(const LoadedScene& scene, const BackendTypes& types, pipeline::MemoryLedger& ledger)
    : scene_(scene), types_(types), ledger_(ledger) {
  update();
}

void ModelMemory::update() {
  std::map<world::TypeIndex, std::set<const world::Model*>> models;
  for (const world::ModelledObject& object : scene_.objects) models[object.type].insert(object.model.get());
  for (const auto& [type, distinct] : models) {
    std::size_t bytes = 0;
    for (const world::Model* model : distinct) bytes += model->bytes();
    const std::string_view name = types_.find(scene_.layout.types[type])->name();
    held_.try_emplace(type, ledger_, "models", name, pipeline::Work::kAcrossUser).first->second.set(bytes);
  }
}

}  // namespace grove::node
