#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

#include "node/frontend/frontend_process.h"
#include "node/frontend/world_nodes.h"
#include "node/transport/transport.h"
#include "node/world/joined_world.h"
#include "world/world.h"

namespace grove::stream {

/// What all instances of a world stand on: who makes their backend nodes, the machine, and the roster of who is here.
/// All of it outlives them.
struct WorldSetup {
  node::WorldNodes& nodes;
  std::shared_ptr<world::Players> players;
  const node::FrontendTypes& types;
  node::Machine machine;
  std::size_t maxSharedBytes;  ///< of the data that an instance shares among its visitors
  node::ProcessId process;     ///< names this one among the frontend processes of its backend nodes
  /// The link to the process that owns the world; null if this one does.
  std::shared_ptr<node::FrontendEnd> owner = {};
};

/// A world with the backend nodes that serve its objects, and the frontend process of those who are in it: all
/// across-user state. There is one for everybody, or, in private mode, one for each visitor.
class WorldInstance {
 public:
  /// Has its nodes made, as WorldNodes::make().
  WorldInstance(const WorldSetup& setup, node::Parallelism parallelism, const node::WorldNodes::Progress& progress);

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
  [[nodiscard]] node::LinkTraffic traffic() const { return nodes_->end().traffic(); }
  /// A visitor has left. Any thread.
  void forget(node::SessionId session);
  /// As InstanceNodes::reportModels().
  void reportModels() { nodes_->reportModels(); }

 private:
  void tellBackend();

  const WorldSetup setup_;
  world::World world_;
  double nextUpdate_ = 0.0;
  std::mutex updateMutex_;
  std::uint64_t updates_ = 0;
  world::Edits::Cursor edits_ = 0;  ///< what the backend node knows of them
  const std::unique_ptr<node::InstanceNodes> nodes_;
  node::FrontendProcess frontend_;
  const std::unique_ptr<node::JoinedWorld> joined_;  ///< null if this process owns the world
};

}  // namespace grove::stream
