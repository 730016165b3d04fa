#pragma once

#include <map>
#include <optional>
#include <stop_token>
#include <string>

#include "cli/bench/walk/walk_visitor.h"
#include "cli/bench/walk/walk_world.h"
#include "world/walk.h"

namespace grove::cli {

/// Cost of one visitor's frames.
struct ViewCost {
  int frames = 0;
  /// CPU per frame of the visitor's own work (c_b, c_f and JPEG), without shared data, on demand or not.
  double milliseconds = 0.0;
  std::map<std::string, double> layers;  ///< parts of it, see layersOf()
};

/// Draws the walk's frames for a visitor of these terms and encodes them as JPEG. After a stop request, returns the
/// cost of the frames drawn so far; nothing if there are none.
[[nodiscard]] std::optional<ViewCost> measureViewCost(WalkWorld& world, const world::Walk& walk, double seconds,
                                                      const WalkVisitor::Terms& terms, Pace pace,
                                                      const std::stop_token& stop);

}  // namespace grove::cli
