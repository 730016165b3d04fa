#include "cli/bench/view/view_memory.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include "cli/bench/view/jpeg_of_visitors.h"
#include "cli/bench/walk/walk_visitor.h"
#include "cli/figures.h"
#include "measure/touched_memory.h"

namespace grove::cli {
namespace {

constexpr int kSamples = 10;
/// Warm-up frames before each measured frame: they make the pictures that visitors share.
constexpr int kFramesBefore = 5;
constexpr auto kFrameTime = std::chrono::milliseconds(33);

}  // namespace

std::optional<std::int64_t> measureViewMemory(WalkWorld& world, const world::Walk& walk, double seconds,
                                              const PictureSize& size, const std::stop_token& stop) {
  WalkVisitor visitor(world, {.size = size}, jpegOfVisitors());
  const auto draw = [&](int frame) {
    static_cast<void>(visitor.draw(world.momentAt(walk.thereAndBack(frame / kWalkFramesPerSecond))));
    world.workers().drain();
  };
  WalkWorld::awaitRest();
  const double frames = seconds * kWalkFramesPerSecond;
  std::vector<double> samples;
  for (int i = 0; i < kSamples; ++i) {
    if (stop.stop_requested()) return std::nullopt;
    const auto measured = static_cast<int>(frames * (i + 0.5) / kSamples);
    for (int frame = std::max(0, measured - kFramesBefore); frame < measured; ++frame) draw(frame);
    const auto nothing = measure::touchedBytes([] { std::this_thread::sleep_for(kFrameTime); });
    const auto drawing = measure::touchedBytes([&] { draw(measured); });
    if (!nothing || !drawing) return std::nullopt;
    samples.push_back(static_cast<double>(*drawing - *nothing));
  }
  return static_cast<std::int64_t>(median(samples));
}

}  // namespace grove::cli
