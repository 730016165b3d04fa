#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string_view>
#include <vector>

#include "node/backend/backend_node.h"
#include "node/frontend/frontend_node.h"
#include "node/registry.h"
#include "node/transport/transport.h"
#include "pipeline/memory_ledger.h"
#include "pipeline/timeline.h"
#include "raster/image.h"
#include "world/world.h"

namespace grove::stream {

/// What all copies of a world stand on: its geometry, the machine, and the roster of who is here. All of it outlives
/// them.
struct WorldGround {
  const world::World::Layout& layout;
  std::shared_ptr<const world::WorldGeometry> geometry;
  std::shared_ptr<world::Players> players;
  const node::Registry& registry;
  pipeline::Executor& workers;
  gl::Workers& gl;
  pipeline::Timeline& timeline;
  pipeline::MemoryLedger& memory;
  raster::ImagePool& images;
  node::BakedStore* baked;  ///< null if there is one copy only
};

/// What a world may take of the machine while it is made.
enum class Haste {
  kAllCores,  ///< nobody is in another one yet
  kNone,      ///< the calling thread alone makes it, one step after the other: the workers are theirs who are inside
};

/// A world with the backend nodes that own its objects: all across-user state. There is one for everybody, or, in
/// private mode, one for each visitor.
class WorldCopy {
 public:
  /// Prepares the backends, which may take seconds; throws what they throw. Not on one of the executors' threads.
  /// `progress` is called from any thread, and may throw to end it.
  WorldCopy(const WorldGround& ground, std::unique_ptr<node::Transport> transport, Haste haste,
            const std::function<void(std::string_view, float)>& progress);

  /// Waits for the runs in progress, so not on one of the executors' threads.
  ~WorldCopy();
  WorldCopy(const WorldCopy&) = delete;
  WorldCopy& operator=(const WorldCopy&) = delete;

  [[nodiscard]] world::World& world() noexcept { return world_; }
  [[nodiscard]] node::FrontendServices frontendServices();
  /// Of all across-user work, see node::BackendHalf.
  void setQuality(int step);
  /// A visitor has left.
  void forget(node::SessionId session);
  /// Of the memory that the models take, which changes when one shows something finer. One thread at a time.
  void tellModels();

 private:
  const WorldGround ground_;
  world::World world_;
  std::map<world::TypeIndex, pipeline::HeldMemory> models_;
  const std::unique_ptr<node::Transport> transport_;
  std::vector<std::unique_ptr<node::BackendNode>> backends_;
};

}  // namespace grove::stream
