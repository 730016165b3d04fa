#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>

#include "node/backend/backend_node.h"
#include "node/frontend/frontend_process.h"
#include "node/object_types.h"
#include "node/transport/node_router.h"
#include "node/transport/transport.h"
#include "node/world/joined_world.h"
#include "pipeline/memory_ledger.h"
#include "world/world.h"

namespace grove::stream {

/// What all instances of a world stand on: what it is made of, the machine, and the roster of who is here. All of it
/// outlives them.
struct WorldGround {
  const node::LoadedScene& scene;
  std::shared_ptr<const world::WorldGeometry> geometry;
  std::shared_ptr<world::Players> players;
  const node::ObjectTypes& types;
  node::BackendMachine machine;
  std::size_t maxSharedBytes;  ///< of the data that an instance shares among its visitors
  node::ProcessId process;     ///< names this one among the frontend processes of its backend nodes
  /// The link to the process that owns the world; null if this one does.
  std::shared_ptr<node::FrontendEnd> owner = {};
  /// Links to nodes of other processes, which serve some of the objects; null if there are none.
  node::NodeRouter* others = nullptr;
};

/// A world with a backend node that owns its objects, but for those that nodes in other processes serve, and the
/// frontend process of those who are in it: all across-user state. There is one for everybody, or, in private mode, one
/// for each visitor.
class WorldInstance {
 public:
  /// Prepares the objects, which may take seconds; throws what they throw. Not on one of the executors' threads.
  /// `progress` is called from any thread, and may throw to end it.
  WorldInstance(const WorldGround& ground, std::unique_ptr<node::Transport> transport, node::Parallelism parallelism,
                const node::BackendNode::Progress& progress);

  /// Waits for the runs in progress, so not on one of the executors' threads.
  ~WorldInstance();
  WorldInstance(const WorldInstance&) = delete;
  WorldInstance& operator=(const WorldInstance&) = delete;

  [[nodiscard]] world::World& world() noexcept { return world_; }
  [[nodiscard]] node::FrontendProcess& frontend() noexcept { return frontend_; }

  /// Sends who is here and what they do to the backend node, or to the world's owner, whose answer then goes to the
  /// backend node. One thread, that of publishIfDue().
  void publish();
  /// The same if it was sent a thirtieth of a second ago, for as long as somebody is here. Returns when to ask again.
  double publishIfDue(double now);
  /// Seconds of the world's clock, which is this process's unless another one owns the world. Any thread.
  [[nodiscard]] double worldSeconds(double now) const;
  /// How this process stands with the world's owner; nothing if it is the owner. Any thread.
  [[nodiscard]] std::optional<node::JoinedWorld::Status> joined(double now) const;

  /// Of all across-user work, see node::BackendHalf. Any thread.
  void setQuality(int step);
  /// What travels between the frontend and the backend node.
  [[nodiscard]] node::LinkTraffic traffic() const { return nodes_.traffic(); }
  /// A visitor has left. Any thread.
  void forget(node::SessionId session);
  /// Of the memory that the models take, which changes when one shows something finer. One thread at a time.
  void reportModels();

 private:
  void tellBackend();

  const WorldGround ground_;
  world::World world_;
  std::map<world::TypeIndex, pipeline::HeldMemory> models_;
  double nextUpdate_ = 0.0;
  std::mutex updateMutex_;
  std::uint64_t updates_ = 0;
  world::Edits::Cursor edits_ = 0;  ///< what the backend node knows of them
  const std::shared_ptr<node::Transport> transport_;
  node::FrontendEnd& nodes_;  ///< the transport, or the way to it and to the others
  const node::LoadedScene own_;
  node::BackendNode backend_;
  const std::shared_ptr<void> served_;  ///< the frontend by the backend
  node::FrontendProcess frontend_;
  const std::unique_ptr<node::JoinedWorld> joined_;  ///< null if this process owns the world
};

}  // namespace grove::stream
