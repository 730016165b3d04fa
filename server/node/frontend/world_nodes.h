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

/// What a process lends to its nodes. All of it outlives them.
struct Machine {
  pipeline::Executor& workers;
  pipeline::Timeline& timeline;
  pipeline::MemoryLedger& memory;
  raster::ImagePool& images;
};

/// The backend nodes of one instance of a world, as its frontend process reaches them. The frontend process goes first.
class InstanceNodes {
 public:
  virtual ~InstanceNodes() = default;
  /// Any thread.
  [[nodiscard]] virtual FrontendEnd& end() = 0;
  /// Of the memory that models in this process take, which changes when one shows something finer. One thread at a
  /// time.
  virtual void reportModels() {}
};

/// Where a frontend process gets the backend nodes of a world, in this process or in others. It outlives the instances.
class WorldNodes {
 public:
  /// Told a step of a preparation and its share, 0 to 1, from any thread. May throw to end it.
  using Progress = std::function<void(std::string_view, float)>;

  virtual ~WorldNodes() = default;
  /// Any thread.
  [[nodiscard]] virtual const world::Layout& layout() const = 0;
  /// The nodes of one more instance. May take seconds; passes on what preparations throw. One at a time, not on one of
  /// the executors' threads.
  [[nodiscard]] virtual std::unique_ptr<InstanceNodes> make(Parallelism parallelism, const Progress& progress) = 0;
  /// The links to several nodes; empty if one node serves all. Any thread.
  [[nodiscard]] virtual std::vector<NodeRouter::NodeLink> links() const { return {}; }
  /// See NodeRouter::traces().
  [[nodiscard]] virtual std::vector<NodeRouter::NodeEvents> traces(std::chrono::milliseconds /*max*/) const {
    return {};
  }
};

/// How many instances of a world there will be.
enum class Instances : std::uint8_t {
  kOne,
  kMany,  ///< what one bakes is kept for the next
};

/// Makes the nodes of a world on a machine. May take seconds, and throws what they throw.
using WorldNodesFactory = std::function<std::unique_ptr<WorldNodes>(const Machine&, Instances)>;

}  // namespace grove::node
