#pragma once

#include <map>
#include <optional>
#include <stop_token>
#include <string>

#include "cli/bench/picture_size.h"
#include "cli/bench/walk/walk_world.h"
#include "world/walk.h"

namespace grove::cli {

/// What each of many visitors costs who see the same view of a world that stands still.
struct StandCost {
  int visitors = 0;
  int frames = 0;                        ///< of all visitors together
  double milliseconds = 0.0;             ///< CPU of the whole process, of a frame
  std::map<std::string, double> layers;  ///< of a frame's own work, see layersOf()
  double visitorBytes = 0.0;             ///< memory that each visitor holds
};

/// Lets smoke rise and simulations come to rest, then draws and encodes as JPEG a frame of each visitor in turn, from
/// where the walk begins. Their clock advances by a thirtieth of a second each turn, however long that takes. After a
/// stop request, returns the cost of the turns so far; nothing if there are none.
[[nodiscard]] std::optional<StandCost> measureStandCost(WalkWorld& world, const world::Walk& walk, int visitors,
                                                        double seconds, const PictureSize& size,
                                                        const std::stop_token& stop);

}  // namespace grove::cli
