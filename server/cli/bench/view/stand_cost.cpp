#include "cli/bench/view/stand_cost.h"

#include <cstdint>
#include <memory>
#include <vector>

#include "cli/bench/view/jpeg_of_visitors.h"
#include "cli/bench/view/view_layers.h"
#include "cli/bench/walk/walk_visitor.h"
#include "measure/amortization.h"

namespace grove::cli {
namespace {

/// Warm-up turns, until every visitor has all backdrops.
constexpr int kWarmUpTurns = 30;

void riseAndRest(WalkWorld& world, const world::Walk& walk, const std::stop_token& stop) {
  const auto nobodyLooks = [](const Moment&) {};
  world.walk(walk, 0.0, Pace::kThirtyASecond, nobodyLooks, nobodyLooks, stop);
  WalkWorld::awaitRest();
}

}  // namespace

std::optional<StandCost> measureStandCost(WalkWorld& world, const world::Walk& walk, int visitors, double seconds,
                                          const PictureSize& size, const std::stop_token& stop) {
  const auto read = [&world] {
    world.workers().drain();
    return measure::Reading::of(world.timeline());
  };
  riseAndRest(world, walk, stop);
  std::vector<std::unique_ptr<WalkVisitor>> all;
  for (int i = 1; i <= visitors; ++i) {
    const WalkVisitor::Terms terms{.number = static_cast<std::uint32_t>(i), .size = size};
    all.push_back(std::make_unique<WalkVisitor>(world, terms, jpegOfVisitors()));
  }
  Moment moment = world.momentAt(walk.at(0.0));
  StandCost cost;
  cost.visitors = visitors;
  std::optional<measure::Reading> before;
  const auto turns = static_cast<int>(seconds * kWalkFramesPerSecond);
  for (int turn = -kWarmUpTurns; turn < turns && !stop.stop_requested(); ++turn) {
    if (turn == 0) before = read();
    for (const auto& visitor : all) static_cast<void>(visitor->draw(moment));
    moment.time += 1.0 / kWalkFramesPerSecond;
    if (before) cost.frames += visitors;
  }
  if (!before || cost.frames == 0) return std::nullopt;
  const measure::Reading after = read();
  cost.milliseconds = 1000.0 * (after.processSeconds - before->processSeconds) / cost.frames;
  cost.layers =
      layersOf(*before, after, {.visitors = static_cast<double>(visitors), .frames = static_cast<double>(cost.frames)});
  const measure::MemoryShare memory = sum(measure::memoryShares(world.memory(), visitors));
  cost.visitorBytes = memory.perUserBackend + memory.perUserFrontend;
  return cost;
}

}  // namespace grove::cli
