#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "node/backend/backend_pipeline.h"
#include "node/backend/peers.h"
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
  BakedStore* baked = nullptr;  ///< null if there is one instance of the world only
};

/// What a world may take of the machine while it is made.
enum class Haste : std::uint8_t {
  kAllCores,  ///< nobody is in another one yet
  kNone,      ///< the calling thread alone makes it, one step after the other: the workers are theirs who are inside
};

/// Owns all objects of a world and answers requests for them: a pipeline for each type. Knows of frontend processes
/// what their messages say, and nothing else.
class BackendNode {
 public:
  using Progress = std::function<void(std::string_view, float)>;

  /// Prepares the objects, which may take seconds; throws what that throws. Not on one of the executors' threads.
  /// `progress` is called from any thread, and may throw to end it. All but it outlive the node.
  BackendNode(const LoadedScene& scene, const world::WorldGeometry& geometry, const BackendTypes& types,
              const BackendMachine& machine, Haste haste, const Progress& progress);
  /// Waits for the runs in progress, so not on one of the executors' threads. All tokens of accept() are gone.
  ~BackendNode();
  BackendNode(const BackendNode&) = delete;
  BackendNode& operator=(const BackendNode&) = delete;

  /// Serves the frontend process at the other end of the link until the token that it returns is gone, which waits for
  /// what is being received; so not from within. What it says of sessions has to concern its own. The link lives on
  /// until the last answer to it is made. Any thread.
  [[nodiscard]] std::shared_ptr<void> accept(std::shared_ptr<BackendEnd> link);

 private:
  class Reception;

  [[nodiscard]] BackendServices services(Haste haste, const Progress& progress);
  pipeline::PushResult receive(const std::shared_ptr<Peer>& peer, ToBackend message);
  pipeline::PushResult take(Asked asked);
  /// Agrees with a frontend process on the protocol, the scene and its types, or refuses it. What it was before is
  /// over.
  void greet(const std::shared_ptr<Peer>& peer, const NodeHello& hello);
  void dismiss(Peer& peer);
  pipeline::PushResult apply(Peer& peer, std::shared_ptr<const WorldUpdate> update);
  void forget(Peer& peer, SessionId session);
  void adjustQuality();
  [[nodiscard]] std::optional<std::string> objectionTo(const NodeHello& hello) const;
  [[nodiscard]] NodeWelcome welcome() const;

  const LoadedScene& scene_;
  const world::WorldGeometry& geometry_;
  const BackendMachine machine_;
  WorldMirror world_;
  Peers peers_;
  std::map<world::TypeIndex, std::unique_ptr<BackendPipeline>> pipelines_;
  std::map<world::ObjectId, BackendPipeline*> owners_;
  BackendPipeline* visitors_ = nullptr;  ///< of the objects that show them
  std::mutex qualityMutex_;
  int quality_ = 0;  ///< of all halves
};

}  // namespace grove::node
