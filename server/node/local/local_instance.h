#pragma once

#include <memory>

#include "node/backend/backend_node.h"
#include "node/backend/prepare/load_scene.h"
#include "node/backend/prepare/model_memory.h"
#include "node/frontend/world_nodes.h"

namespace grove::node {

/// One instance's backend node in this process, which owns the objects that no node of another process serves.
class LocalInstance final : public InstanceNodes {
 public:
  /// The common parts of all instances, which outlive them.
  struct Ground {
    const LoadedScene& scene;
    const world::WorldGeometry& geometry;
    const BackendTypes& types;
    BackendMachine machine;
    NodeRouter* others;  ///< null: this node owns all
  };
  /// Prepares the objects; as BackendNode.
  LocalInstance(const Ground& ground, std::shared_ptr<Transport> transport, Parallelism parallelism,
                const BackendNode::Progress& progress);

  [[nodiscard]] FrontendEnd& end() override { return end_; }
  void reportModels() override { models_.update(); }

 private:
  const Ground ground_;
  ModelMemory models_;
  const std::shared_ptr<Transport> transport_;
  FrontendEnd& end_;  ///< the transport, or the router to it and to the other nodes
  const LoadedScene own_;
  BackendNode backend_;
  const std::shared_ptr<void> served_;  ///< the backend node's token for the frontend process
};

}  // namespace grove::node
