#include "cli/bench/encode/record_walk.h"

#include "cli/bench/walk/walk_visitor.h"

namespace grove::cli {

KeptFrames recordWalk(WalkWorld& world, const world::Walk& walk, double seconds, const PictureSize& size,
                      const std::stop_token& stop) {
  KeptFrames frames(size.width, size.height);
  WalkVisitor visitor(world, {.size = size});
  world.walk(
      walk, seconds, Pace::kThirtyASecond, [&](const Moment& moment) { static_cast<void>(visitor.draw(moment)); },
      [&](const Moment& moment) { frames.add(moment.pose, *visitor.draw(moment).picture); }, stop);
  return frames;
}

}  // namespace grove::cli
