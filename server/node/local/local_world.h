#pragma once

#include <memory>

#include "node/backend/backend_node.h"
#include "node/backend/prepare/load_scene.h"
#include "node/backend/prepare/model_memory.h"
#include "node/frontend/world_nodes.h"
#include "pipeline/memory_ledger.h"

namespace grove::node {

/// A world whose objects this process owns, except for those that nodes in other processes serve.
class LocalWorld final : public WorldNodes {
 public:
  /// Prepares the objects, as BackendNode. `makeTransport` makes the link between the frontend process and the backend
  /// node; empty: they share memory. `others` are nodes of other processes; null if there are none. Types and GL
  /// workers outlive the world.
  LocalWorld(LoadedScene scene, const BackendTypes& types, gl::Workers& gl, const Machine& machine,
             const Progress& progress, const TransportFactory& makeTransport = {},
             std::unique_ptr<NodeRouter> others = nullptr);

  [[nodiscard]] const world::Layout& layout() const override { return scene_.layout; }
  [[nodiscard]] FrontendEnd& end() override { return end_; }
  void reportModels() override { models_.update(); }
  [[nodiscard]] std::vector<NodeRouter::NodeLink> links() const override;
  [[nodiscard]] std::vector<NodeRouter::NodeEvents> traces(std::chrono::milliseconds max) const override;

 private:
  const LoadedScene scene_;
  const std::unique_ptr<NodeRouter> others_;
  const world::WorldGeometry geometry_;
  const pipeline::HeldMemory geometryMemory_;
  ModelMemory models_;
  const std::shared_ptr<Transport> transport_;
  FrontendEnd& end_;  ///< the transport, or the router to it and to the other nodes
  const LoadedScene own_;
  BackendNode backend_;
  const std::shared_ptr<void> served_;  ///< the backend node's token for the frontend process
};

/// Makes a LocalWorld without nodes of other processes.
[[nodiscard]] WorldNodesFactory localWorld(LoadedScene scene, const BackendTypes& types, gl::Workers& gl,
                                           TransportFactory makeTransport = {});

}  // namespace grove::node
