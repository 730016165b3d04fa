#include "cli/bench/view/view_cost.h"

#include "cli/bench/view/jpeg_of_visitors.h"
#include "cli/bench/view/view_layers.h"
#include "measure/amortization.h"

namespace grove::cli {

std::optional<ViewCost> measureViewCost(WalkWorld& world, const world::Walk& walk, double seconds,
                                        const WalkVisitor::Terms& terms, Pace pace, const std::stop_token& stop) {
  // A frame's last runs may end after its arrival.
  const auto read = [&world] {
    world.workers().drain();
    return measure::Reading::of(world.timeline());
  };
  WalkVisitor visitor(world, terms, jpegOfVisitors());
  ViewCost cost;
  std::optional<measure::Reading> before;
  world.walk(
      walk, seconds, pace, [&](const Moment& moment) { static_cast<void>(visitor.draw(moment)); },
      [&](const Moment& moment) {
        if (!before) before = read();
        static_cast<void>(visitor.draw(moment));
        ++cost.frames;
      },
      stop);
  if (!before) return std::nullopt;
  const measure::Reading after = read();
  const measure::Served served{.visitors = 1.0, .frames = static_cast<double>(cost.frames)};
  const measure::FrameCost all = sum(measure::frameCosts(*before, after, served));
  cost.milliseconds = all.perUser() - all.onDemandOwn;
  cost.layers = layersOf(*before, after, served);
  return cost;
}

}  // namespace grove::cli
