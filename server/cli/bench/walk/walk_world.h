#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string_view>
#include <vector>

#include "gl/workers.h"
#include "node/local/local_world.h"
#include "node/object_types.h"
#include "pipeline/memory_ledger.h"
#include "pipeline/timeline.h"
#include "pipeline/worker_pool.h"
#include "raster/image.h"
#include "stream/session/world_instance.h"
#include "world/camera.h"
#include "world/light.h"
#include "world/walk.h"
#include "world/world.h"

namespace grove::cli {

inline constexpr double kWalkFramesPerSecond = 30.0;
inline constexpr double kDisplayFramesPerSecond = 60.0;

/// Pose, time and lights that determine a frame.
struct Moment {
  world::Pose pose;
  double time = 0.0;  ///< seconds of the world's clock
  std::vector<world::PointLight> lights;
};

/// Timing of a walk's frames.
enum class Pace : std::uint8_t {
  kThirtyASecond,  ///< one begins every 1/30 s, or later if the previous one takes longer
  kSixtyASecond,   ///< the same, every 1/60 s
  kOneAfterOther,  ///< as fast as possible
};

/// The world of a bench's walk: the pipeline of a server, without host and sessions. Its visitors are WalkVisitors. One
/// thread, not one of the executors'.
class WalkWorld {
 public:
  /// Prepares the world, which may take seconds; throws what backends throw. Pictures are as accurate as if `busyShare`
  /// of the workers were busy. The types outlive this.
  WalkWorld(node::LoadedScene scene, const node::ObjectTypes& types, gl::Workers& gl,
            const std::function<void(std::string_view, float)>& progress, double busyShare = 0.0);

  /// Draws the frame of a moment.
  using Look = std::function<void(const Moment&)>;

  /// Calls `warmUp` and then `look` once for each frame of the walk, back and forth: as many frames as `seconds` has at
  /// the pace's rate, 30 per second if it has none. The warm-up takes a second at the walk's begin, and the first one until smoke
  /// has risen. Simulations tick meanwhile. Between two frames smoke advances as for visitors if frames are on time,
  /// and farther if a frame takes longer. Returns early after a stop request.
  void walk(const world::Walk& walk, double seconds, Pace pace, const Look& warmUp, const Look& look,
            const std::stop_token& stop);

  /// Waits until simulations are at rest, as in a world without visitors.
  static void awaitRest();

  /// Returns the current moment, seen from this pose of a walk.
  [[nodiscard]] Moment momentAt(const world::Pose& pose);

  [[nodiscard]] stream::WorldInstance& instance() noexcept { return instance_; }
  [[nodiscard]] pipeline::WorkerPool& workers() noexcept { return workers_; }
  [[nodiscard]] pipeline::Timeline& timeline() noexcept { return timeline_; }
  [[nodiscard]] const pipeline::MemoryLedger& memory() const noexcept { return memory_; }

 private:
  pipeline::Timeline timeline_;
  pipeline::MemoryLedger memory_;
  raster::ImagePool images_;
  pipeline::WorkerPool workers_;
  node::LocalWorld nodes_;
  const std::shared_ptr<world::Players> players_;
  stream::WorldInstance instance_;
  bool warm_ = false;
};

}  // namespace grove::cli
