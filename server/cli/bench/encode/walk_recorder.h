#pragma once

#include <functional>
#include <memory>
#include <stop_token>
#include <string_view>

#include "cli/bench/encode/kept_frames.h"
#include "gl/workers.h"
#include "node/object_types.h"
#include "pipeline/memory_ledger.h"
#include "pipeline/timeline.h"
#include "pipeline/worker_pool.h"
#include "raster/image.h"
#include "stream/session/world_instance.h"
#include "world/walk.h"
#include "world/world.h"

namespace grove::cli {

inline constexpr double kRecordedFramesPerSecond = 30.0;

/// A world with one visitor, whose frames are kept instead of encoded: the pipeline that serves, without a host and
/// sessions. One thread, not one of the executors'.
class WalkRecorder {
 public:
  /// Prepares the world, which may take seconds; throws what backends throw. The scene and the types outlive it.
  WalkRecorder(const node::LoadedScene& scene, const node::ObjectTypes& types, gl::Workers& gl,
               const std::function<void(std::string_view, float)>& progress);

  /// What he sees who goes along the walk, there and back again. One frame is begun each thirtieth of a second, so that
  /// smoke moves between two of them as far as it does for visitors; where a frame takes longer than that, farther. If
  /// it is to stop, returns what there is.
  [[nodiscard]] KeptFrames record(const world::Walk& walk, double seconds, int width, int height,
                                  const std::stop_token& stop);

 private:
  const std::shared_ptr<world::Players> players_;
  pipeline::Timeline timeline_;
  pipeline::MemoryLedger memory_;
  raster::ImagePool images_;
  pipeline::WorkerPool workers_;
  stream::WorldInstance instance_;
  bool warm_ = false;
};

}  // namespace grove::cli
