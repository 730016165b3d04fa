#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "stream/load/link/link_profile.h"
#include "stream/protocol/protocol.h"
#include "world/walk.h"

namespace grove::stream {

/// How the visitors of a load test move.
enum class Movement : std::uint8_t {
  kStroll,  ///< a few steps in changing directions, looking around
  kLook,    ///< look around only
  kStand,   ///< neither; inputs are still sent, to measure latency
};

/// A walk that the visitors of a load test follow.
struct WalkToFollow {
  world::Walk walk;
  /// Where visitors arrive in the walk's world.
  world::Vec3 spawn{0.0F};
  float spawnYaw = 0.0F;  ///< radians
};

/// What a load test does.
struct LoadPlan {
  int sessions = 1;
  int firstVisitor = 0;    ///< index of the first session's visitor
  double countFrom = 0.0;  ///< earliest begin of the measurement, pipeline::wallSeconds()
  double seconds = 10.0;   ///< measured
  int width = 1280;        ///< pixels, wanted
  int height = 720;        ///< pixels, wanted
  std::vector<std::uint8_t> codecs = {kCodecH264, kCodecJpegPatches, kCodecJpeg};  ///< offered, the best first
  bool lateWalk = false;  ///< ask for what a page needs that moves pictures
  Movement movement = Movement::kStroll;
  std::optional<WalkToFollow> follow = {};  ///< replaces `movement`
  std::optional<LinkProfile> shape = {};    ///< of each visitor's own line
};

}  // namespace grove::stream
