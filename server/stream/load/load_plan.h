#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "stream/load/link/link_profile.h"
#include "stream/protocol/protocol.h"
#include "world/walk.h"

namespace grove::stream {

/// What the visitors of a load test do with their keys and their heads.
enum class Movement : std::uint8_t {
  kStroll,  ///< a few steps this way and that, looking about
  kLook,    ///< looking about only
  kStand,   ///< neither; inputs are sent all the same, so that latency is measured
};

/// A walk that visitors of a load test go along.
struct WalkToFollow {
  world::Walk walk;
  /// Where visitors arrive in the world that the walk is made for.
  world::Vec3 spawn{0.0F};
  float spawnYaw = 0.0F;  ///< radians
};

/// What a load test is.
struct LoadPlan {
  int sessions = 1;
  int firstVisitor = 0;                                         ///< number of the first session's visitor
  double countFrom = 0.0;                                       ///< pipeline::wallSeconds(); counting begins no earlier
  double seconds = 10.0;                                        ///< that are counted
  int width = 1280;                                             ///< pixels, wanted
  int height = 720;                                             ///< pixels, wanted
  std::vector<std::uint8_t> codecs = {kCodecH264, kCodecJpeg};  ///< that are offered, the best first
  Movement movement = Movement::kStroll;
  std::optional<WalkToFollow> follow = {};  ///< instead
  std::optional<LinkProfile> shape = {};    ///< of the line that each visitor has for himself
};

}  // namespace grove::stream
