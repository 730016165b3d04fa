#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "node/parallelism.h"
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

/// The backend nodes of one instance of a world, as its frontend process reaches them. They outlive the frontend
/// process.
class InstanceNodes {
 public:
  virtual ~InstanceNodes() = default;
  /// Thread-safe.
  [[nodiscard]] virtual FrontendEnd& end() = 0;
  /// Reports the memory of models in this process, which changes with finer light fields. One thread at a time.
  virtual void reportModels() {}
};

/// Makes the backend nodes of a world for a frontend process, in this process or in others. Outlives the instances.
class WorldNodes {
 public:
  /// Receives a step of a preparation and its share, 0 to 1, from any thread. May throw to end it.
  using Progress = std::function<void(std::string_view, float)>;

  virtual ~WorldNodes() = default;
  /// Thread-safe.
  [[nodiscard]] virtual const world::Layout& layout() const = 0;
  /// Makes the nodes of one more instance. May take seconds; throws what preparations throw. One at a time, not on an
  /// executor's thread.
  [[nodiscard]] virtual std::unique_ptr<InstanceNodes> make(Parallelism parallelism, const Progress& progress) = 0;
  /// The links to several nodes; empty if one node serves all. Thread-safe.
  [[nodiscard]] virtual std::vector<NodeRouter::NodeLink> links() const { return {}; }
  /// See NodeRouter::traces().
  [[nodiscard]] virtual std::vector<NodeRouter::NodeEvents> traces(std::chrono::milliseconds /*max*/) const {
    return {};
  }
};

/// Number of instances of a world.
enum class Instances : std::uint8_t {
  kOne,
  kMany,  ///< baked data of one is kept for the next
};

/// Makes the nodes of a world on a machine. May take seconds; throws what preparations throw.
using WorldNodesFactory = std::function<std::unique_ptr<WorldNodes>(const Machine&, Instances)>;

}  // namespace grove::node
