#include "cli/bench/view/exact_quality.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "cli/bench/walk/walk_visitor.h"
#include "cli/bench/walk/walk_world.h"
#include "measure/pictures/enlarge.h"
#include "measure/pictures/picture_quality.h"

namespace grove::cli {
namespace {

/// One of kEvery frames is compared, because an exact frame takes several times as long as a usual one.
constexpr int kEvery = 5;

struct Sample {
  Moment moment;
  std::vector<std::uint32_t> pixels;
};

world::Scene withoutMovement(world::Scene scene) {
  std::erase_if(scene.objects,
                [](const world::ObjectDescription& object) { return object.type == "fluid" || object.type == "herd"; });
  return scene;
}

world::Scene exactly(world::Scene scene) {
  world::setTypeOption(scene, "lightfield", "view_error", 0.0);
  return scene;
}

}  // namespace

std::optional<ExactQuality> measureExactQuality(const world::Scene& scene, const node::ObjectTypes& types,
                                                gl::Workers& gl, const world::Walk& walk, double seconds,
                                                const PictureSize& size, const Shed& shed,
                                                const std::function<void(std::string_view, float)>& progress,
                                                const std::stop_token& stop) {
  const world::Scene still = withoutMovement(scene);
  const PictureSize shown = inLines(size, shed.lines);
  std::vector<Sample> samples;
  {
    WalkWorld world(node::loadScene(still, types.backends), types, gl, progress, shed.busyShare);
    WalkVisitor visitor(world, {.size = shown});
    int frame = 0;
    world.walk(
        walk, seconds, Pace::kThirtyASecond, [&](const Moment& moment) { static_cast<void>(visitor.draw(moment)); },
        [&](const Moment& moment) {
          const node::FinishedFrame drawn = visitor.draw(moment);
          if (frame++ % kEvery == 0) samples.push_back({moment, raster::rgbaOf(*drawn.picture)});
        },
        stop);
  }
  WalkWorld world(node::loadScene(exactly(still), types.backends), types, gl, progress);
  WalkVisitor visitor(world, {.size = size, .policy = wholePolicy()});
  const measure::Mask all(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height), 1);
  double sum = 0.0;
  double worst = 0.0;
  for (const Sample& sample : samples) {
    if (stop.stop_requested()) return std::nullopt;
    const std::vector<std::uint32_t> exact = raster::rgbaOf(*visitor.draw(sample.moment).picture);
    const std::vector<std::uint32_t> large = measure::enlarged({sample.pixels, shown.width}, size.width, size.height);
    const double error = measure::meanSquareError({large, size.width}, {exact, size.width}, all);
    sum += error;
    worst = std::max(worst, error);
  }
  if (samples.empty()) return std::nullopt;
  return ExactQuality{measure::decibels(sum / static_cast<double>(samples.size())), measure::decibels(worst)};
}

}  // namespace grove::cli
