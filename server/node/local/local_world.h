#pragma once

#include <memory>

#include "node/backend/backend_node.h"
#include "node/backend/prepare/baked_store.h"
#include "node/backend/prepare/load_scene.h"
#include "node/frontend/world_nodes.h"
#include "pipeline/memory_ledger.h"

namespace grove::node {

/// A world whose objects this process owns, except for those that nodes in other processes serve. Each instance has a
/// backend node of its own; all share the obstacles for smoke and light.
class LocalWorld final : public WorldNodes {
 public:
  /// `makeTransport` makes the link between an instance's frontend process and its backend node; empty: they share
  /// memory. `others` are nodes of other processes, for one instance only; null if there are none. Types and GL workers
  /// outlive the world.
  LocalWorld(LoadedScene scene, const BackendTypes& types, gl::Workers& gl, const Machine& machine, Instances instances,
             TransportFactory makeTransport = {}, std::unique_ptr<NodeRouter> others = nullptr);

  [[nodiscard]] const world::Layout& layout() const override { return scene_.layout; }
  [[nodiscard]] std::unique_ptr<InstanceNodes> make(Parallelism parallelism, const Progress& progress) override;
  [[nodiscard]] std::vector<NodeRouter::NodeLink> links() const override;
  [[nodiscard]] std::vector<NodeRouter::NodeEvents> traces(std::chrono::milliseconds max) const override;

 private:
  const LoadedScene scene_;
  const BackendTypes& types_;
  gl::Workers& gl_;
  const Machine machine_;
  const Instances instances_;
  const TransportFactory makeTransport_;
  const std::unique_ptr<NodeRouter> others_;
  std::unique_ptr<const world::WorldGeometry> geometry_;  ///< of all instances; made with the first
  pipeline::HeldMemory geometryMemory_;
  BakedStore baked_;  ///< used if there are many instances
};

/// Makes a LocalWorld without nodes of other processes.
[[nodiscard]] WorldNodesFactory localWorld(LoadedScene scene, const BackendTypes& types, gl::Workers& gl,
                                           TransportFactory makeTransport = {});

}  // namespace grove::node
