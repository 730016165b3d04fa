#pragma once

#include <map>
#include <optional>
#include <stop_token>
#include <string>

#include "cli/bench/picture_size.h"
#include "cli/bench/walk/walk_world.h"
#include "world/walk.h"

namespace grove::cli {

/// Cost of each of many visitors with the same view of a world at rest.
struct StandCost {
  int visitors = 0;
  int frames = 0;                        ///< of all visitors together
  double milliseconds = 0.0;             ///< CPU of the whole process per frame
  std::map<std::string, double> layers;  ///< of the visitor's own work per frame, see layersOf()
  double visitorBytes = 0.0;             ///< memory per visitor
};

/// Lets smoke rise and simulations come to rest, then draws a frame of each visitor in turn from the begin of the walk
/// and encodes it as JPEG. The visitors' clock advances by 1/30 s per turn, whatever its real time. After a stop
/// request, returns the cost of the turns so far; nothing if there are none.
[[nodiscard]] std::optional<StandCost> measureStandCost(WalkWorld& world, const world::Walk& walk, int visitors,
                                                        double seconds, const PictureSize& size,
                                                        const std::stop_token& stop);

}  // namespace grove::cli
