#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "node/backend/backend_pipeline.h"
#include "node/backend/peers/peers.h"
#include "node/backend/prepare/load_scene.h"
#include "node/backend/world_mirror.h"
#include "node/transport/transport.h"

namespace grove::node {

/// The machine that a backend node runs on. All of it outlives the node.
struct BackendMachine {
  pipeline::Executor& workers;
  gl::Workers& gl;
  pipeline::Timeline& timeline;
  pipeline::MemoryLedger& memory;
  raster::ImagePool& images;
};

/// Owns all or some objects of a world and serves requests for them, with one pipeline for each object type. Messages
/// are its only contact with frontend processes.
class BackendNode {
 public:
  using Progress = std::function<void(std::string_view, float)>;

  /// Prepares the objects, which may take seconds; rethrows what preparation throws. Must not run on a thread of the
  /// executors. `progress` is called from any thread and may throw to cancel. All other arguments outlive the node.
  BackendNode(const LoadedScene& scene, const world::WorldGeometry& geometry, const world::VoxelObstacles& obstacles,
              const BackendTypes& types, const BackendMachine& machine, const Progress& progress);
  /// Waits for runs in progress, so it must not run on a thread of the executors. All tokens of accept() must be gone.
  ~BackendNode();
  BackendNode(const BackendNode&) = delete;
  BackendNode& operator=(const BackendNode&) = delete;

  /// Different in each run of a node.
  [[nodiscard]] std::uint64_t epoch() const noexcept { return epoch_; }

  /// Serves the frontend process at the other end of the link until the returned token is destroyed. The token's
  /// destructor waits for messages that are being received, so it must not run inside receive(). Messages about
  /// sessions of other processes are refused. The link stays alive until its last result is made. Thread-safe.
  [[nodiscard]] std::shared_ptr<void> accept(std::shared_ptr<BackendEnd> link);

  /// Sends the stages and the memory of this process to all frontend processes. A server's own node does not need it:
  /// it shares the server's timeline. Thread-safe.
  void report(std::uint64_t residentBytes) const;

 private:
  class Reception;

  [[nodiscard]] BackendServices services(const Progress& progress);
  pipeline::PushResult receive(const std::shared_ptr<Peer>& peer, ToBackend message);
  pipeline::PushResult take(PeerRequest asked);
  /// Starts to make a version for a peer's subscription.
  [[nodiscard]] bool push(std::shared_ptr<Peer> peer, const SharedKey& what, Version known);
  /// Welcomes a frontend process if protocol, scene and types match, else refuses it. A second hello starts over.
  void greet(const std::shared_ptr<Peer>& peer, const NodeHello& hello);
  void dismiss(Peer& peer);
  pipeline::PushResult apply(Peer& peer, std::shared_ptr<const WorldUpdate> update);
  void forget(Peer& peer, SessionId session);
  void sendTrace(Peer& peer, const TraceRequest& request) const;
  void adjustQuality();
  [[nodiscard]] std::optional<std::string> objectionTo(const NodeHello& hello) const;
  [[nodiscard]] NodeWelcome welcome() const;

  const LoadedScene& scene_;
  const world::WorldGeometry& geometry_;
  const world::VoxelObstacles& obstacles_;
  const BackendMachine machine_;
  const std::uint64_t epoch_;
  WorldMirror world_;
  Peers peers_;
  std::map<world::TypeIndex, std::unique_ptr<BackendPipeline>> pipelines_;
  std::map<world::ObjectId, BackendPipeline*> owners_;
  BackendPipeline* visitors_ = nullptr;  ///< serves the visitors' objects
  std::mutex qualityMutex_;
  int quality_ = 0;  ///< of all halves
};

}  // namespace grove::node
