#pragma once

#include <map>

#include "node/backend/prepare/load_scene.h"
#include "pipeline/memory_ledger.h"

namespace grove::node {

/// Reports the memory of a scene's models, by object type. One thread at a time.
class ModelMemory {
 public:
  /// All outlive it.
  ModelMemory(const LoadedScene& scene, const BackendTypes& types, pipeline::MemoryLedger& ledger);

  /// Reports the present sizes, which change when a model gets a finer light field.
  void update();

 private:
  const LoadedScene& scene_;
  const BackendTypes& types_;
  pipeline::MemoryLedger& ledger_;
  std::map<world::TypeIndex, pipeline::HeldMemory> held_;
};

}  // namespace grove::node
