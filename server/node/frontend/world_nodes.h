#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "node/transport/node_router.h"
#include "node/transport/transport.h"
#include "pipeline/executor.h"
#include "pipeline/memory_ledger.h"
#include "pipeline/timeline.h"
#include "raster/image.h"
#include "world/layout.h"

namespace grove::node {

/// Resources that a process lends to its nodes. All of it outlives them.
struct Machine {
  pipeline::Executor& workers;
  pipeline::Timeline& timeline;
  pipeline::MemoryLedger& memory;
  raster::ImagePool& images;
};

/// The backend nodes of a world, in this process or in others, as the frontend process reaches them. They outlive the
/// frontend process. Thread-safe unless noted.
class WorldNodes {
 public:
  /// Receives a step of a preparation and its share, 0 to 1, from any thread. May throw to end it.
  using Progress = std::function<void(std::string_view, float)>;

  virtual ~WorldNodes() = default;
  [[nodiscard]] virtual const world::Layout& layout() const = 0;
  [[nodiscard]] virtual FrontendEnd& end() = 0;
  /// Reports the memory of models in this process, which changes with finer light fields. One thread at a time.
  virtual void reportModels() {}
  /// The links to several nodes; empty if one node serves all.
  [[nodiscard]] virtual std::vector<NodeRouter::NodeLink> links() const { return {}; }
  /// See NodeRouter::traces().
  [[nodiscard]] virtual std::vector<NodeRouter::NodeEvents> traces(std::chrono::milliseconds /*max*/) const {
    return {};
  }
};

/// Makes the nodes of a world on a machine. May take seconds; throws what preparations throw. Must not run on an
/// executor's thread.
using WorldNodesFactory = std::function<std::unique_ptr<WorldNodes>(const Machine&, const WorldNodes::Progress&)>;

}  // namespace grove::node
