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

/// Inputs of a running world: its backend nodes, the machine, and the list of visitors. All of it outlives the world.
struct WorldSetup {
  node::WorldNodes& nodes;
  std::shared_ptr<world::Players> players;
  const node::FrontendTypes& types;
  node::Machine machine;
  std::size_t maxSharedBytes;  ///< of the data that visitors share
  node::ProcessId process;     ///< names this one among the frontend processes of its backend nodes
  /// The link to the process that owns the world; null if this one does.
  std::shared_ptr<node::FrontendEnd> owner = {};
};

/// A running world and its frontend process: all across-user state.
class WorldInstance {
 public:
  explicit WorldInstance(const WorldSetup& setup);

  /// Waits for the runs in progress, so not on one of the executors' threads.
  ~WorldInstance();
  WorldInstance(const WorldInstance&) = delete;
  WorldInstance& operator=(const WorldInstance&) = delete;

  [[nodiscard]] world::World& world() noexcept { return world_; }
  [[nodiscard]] node::FrontendProcess& frontend() noexcept { return frontend_; }

  /// Sends the visitors and their actions to the backend node, or to the world's owner, whose answer then goes to the
  /// backend node. On the thread of publishIfDue() only.
  void publish();
  /// Publishes thirty times a second while there are visitors. Returns when to call again.
  double publishIfDue(double now);
  /// Seconds of the world's clock, which is this process's unless another one owns the world. Thread-safe.
  [[nodiscard]] double worldSeconds(double now) const;
  /// State of the link to the world's owner; empty if this process is the owner. Thread-safe.
  [[nodiscard]] std::optional<node::JoinedWorld::Status> joined(double now) const;

  /// Of all across-user work, see node::BackendHalf. Thread-safe.
  void setQuality(int step);
  /// Traffic between the frontend and the backend node.
  [[nodiscard]] node::LinkTraffic traffic() const { return setup_.nodes.end().traffic(); }
  /// A visitor has left. Thread-safe.
  void forget(node::SessionId session);

 private:
  void sendUpdate();

  const WorldSetup setup_;
  world::World world_;
  double nextUpdate_ = 0.0;
  std::mutex updateMutex_;
  std::uint64_t updates_ = 0;
  world::Edits::Cursor edits_ = 0;  ///< edits that the backend node has received
  node::FrontendProcess frontend_;
  const std::unique_ptr<node::JoinedWorld> joined_;  ///< null if this process owns the world
};

}  // namespace grove::stream
