#pragma once

#include <memory>
#include <vector>

#include "node/frontend/world_nodes.h"
#include "node/transport/node_router.h"
#include "world/layout.h"

namespace grove::node {

/// A world whose objects are all served by nodes in other processes. This process has only those facts of the models
/// that the nodes' welcomes contain.
class RemoteWorld final : public WorldNodes {
 public:
  /// `layout` is that of the scene file (world::layoutOf()). Asserts that the nodes serve all of it. Throws
  /// EnvironmentError if a node serves an object that is not in the file.
  RemoteWorld(world::Layout layout, std::unique_ptr<NodeRouter> nodes);

  [[nodiscard]] const world::Layout& layout() const override { return layout_; }
  [[nodiscard]] FrontendEnd& end() override { return *nodes_; }
  [[nodiscard]] std::vector<NodeRouter::NodeLink> links() const override { return nodes_->links(); }
  [[nodiscard]] std::vector<NodeRouter::NodeEvents> traces(std::chrono::milliseconds max) const override {
    return nodes_->traces(max);
  }

 private:
  const std::unique_ptr<NodeRouter> nodes_;
  const world::Layout layout_;
};

}  // namespace grove::node
