#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "node/backend/backend_pipeline.h"
#include "node/backend/ended_frames.h"
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

/// Owns all objects of a world and answers requests for them: a pipeline for each type. Knows of frontends what their
/// messages say, and nothing else.
class BackendNode final : public BackendPort {
 public:
  using Progress = std::function<void(std::string_view, float)>;

  /// Prepares the objects, which may take seconds; throws what that throws. Not on one of the executors' threads.
  /// `progress` is called from any thread, and may throw to end it. All but it outlive the node.
  BackendNode(const LoadedScene& scene, const world::WorldGeometry& geometry, const BackendTypes& types,
              const BackendMachine& machine, BackendEnd& transport, Haste haste, const Progress& progress);
  /// Waits for the runs in progress, so not on one of the executors' threads.
  ~BackendNode() override;
  BackendNode(const BackendNode&) = delete;
  BackendNode& operator=(const BackendNode&) = delete;

  pipeline::PushResult receive(ToBackend message) override;

 private:
  [[nodiscard]] BackendServices services(Haste haste, const Progress& progress);
  pipeline::PushResult take(Request request);
  /// Agrees with a frontend process on the protocol, the scene and its types, or refuses it.
  void greet(const NodeHello& hello);
  [[nodiscard]] std::optional<std::string> objectionTo(const NodeHello& hello) const;
  [[nodiscard]] NodeWelcome welcome() const;

  const LoadedScene& scene_;
  const world::WorldGeometry& geometry_;
  const BackendMachine machine_;
  BackendEnd& transport_;
  WorldMirror world_;
  EndedFrames ended_;
  std::map<world::TypeIndex, std::unique_ptr<BackendPipeline>> pipelines_;
  std::map<world::ObjectId, BackendPipeline*> owners_;
  std::atomic<bool> welcomed_{false};    ///< the frontend process; until then its requests are refused
  BackendPipeline* visitors_ = nullptr;  ///< of the objects that show them
};

}  // namespace grove::node
