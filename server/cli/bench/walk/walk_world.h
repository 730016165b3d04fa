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

/// What all who look at the same time from the same place see.
struct Moment {
  world::Pose pose;
  double time = 0.0;  ///< seconds of the world's clock
  std::vector<world::PointLight> lights;
};

/// How a walk's frames follow one another.
enum class Pace : std::uint8_t {
  kThirtyASecond,  ///< one is begun each thirtieth of a second, or later where the one before takes longer
  kOneAfterOther,  ///< as fast as they are made
};

/// The world that a bench walks through: the pipeline that serves, without a host and sessions. Its visitors are
/// WalkVisitors. One thread, not one of the executors'.
class WalkWorld {
 public:
  /// Prepares the world, which may take seconds; throws what backends throw. The types outlive it.
  WalkWorld(node::LoadedScene scene, const node::ObjectTypes& types, gl::Workers& gl,
            const std::function<void(std::string_view, float)>& progress);

  /// Is called with the moment that a frame shows.
  using Look = std::function<void(const Moment&)>;

  /// Lets `warmUp` look and then `look`, once for each frame of the walk, there and back again: so many frames as make
  /// `seconds` at thirty a second, whatever the pace. The warm-up is a second at the walk's beginning, and the first
  /// one as long as smoke takes to rise. Simulations tick meanwhile. Between two frames smoke moves as far as it does
  /// for visitors, if they come in time; where a frame takes longer, farther. If it is to stop, returns early.
  void walk(const world::Walk& walk, double seconds, Pace pace, const Look& warmUp, const Look& look,
            const std::stop_token& stop);

  /// Waits until simulations are at rest, as they are while nobody walks.
  static void awaitRest();

  /// Now, seen from there.
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
