#include "cli/bench/view/bench_view.h"

#include <cstdio>

#include "cli/bench/view/bench_view_report.h"
#include "cli/bench/walk/fire_walks.h"
#include "cli/bench/walk/walk_world.h"
#include "cli/prepare/prepare_world.h"
#include "cli/prepare/progress.h"
#include "cli/stop_on_signal.h"
#include "gl/shader_library.h"
#include "objects/builtin.h"

namespace grove::cli {
namespace {

void measureInto(ViewReport& report, WalkWorld& world, const world::Walk& walk, const BenchViewOptions& options,
                 Progress& progress, const std::stop_token& stop) {
  const double seconds = options.seconds;
  const PictureSize& size = options.size;
  if (options.stand) {
    progress.show("drawing the view of standing visitors", 0.0F);
    report.standing = measureStandCost(world, walk, options.visitors, seconds, size, stop);
    return;
  }
  progress.show("drawing a walk at 30 frames per second", 0.0F);
  report.paced = measureViewCost(world, walk, seconds, {.size = size}, Pace::kThirtyASecond, stop);
  progress.show("drawing it as fast as possible", 0.0F);
  report.inLoop = measureViewCost(world, walk, seconds, {.size = size}, Pace::kOneAfterOther, stop);
  progress.show("drawing everything in every frame", 0.0F);
  const WalkVisitor::Terms whole{.size = size, .policy = wholePolicy()};
  report.whole = measureViewCost(world, walk, seconds, whole, Pace::kThirtyASecond, stop);
  progress.show("comparing it with drawing everything", 0.0F);
  report.quality = measureViewQuality(world, walk, seconds, size, stop);
  progress.show("finding the memory that a frame touches", 0.0F);
  if (!stop.stop_requested()) report.bytes = measureViewMemory(world, walk, seconds, size, stop);
}

std::string jsonOf(const ViewReport& report, const BenchViewOptions& options) {
  if (options.exact) return exactJson(report);
  return options.stand ? standJson(report) : viewJson(report);
}

void printText(const ViewReport& report, const BenchViewOptions& options) {
  if (options.exact) {
    printExact(report);
  } else if (options.stand) {
    printStand(report);
  } else {
    printView(report);
  }
}

}  // namespace

int runBenchView(const BenchViewOptions& options) {
  std::optional<world::Walk> walk;
  if (options.walk) walk = world::loadWalk(*options.walk);

  const StopOnSignal stop;
  ViewReport report;
  report.walk = options.walk.value_or(kRoundWalkName);
  report.size = options.size;
  report.shed = options.shed;
  const world::Scene scene = openScene(options.scene);
  const gl::ShaderLibrary shaders;
  gl::Workers gl(gl::ContextKind::kAuto, shaders);
  Progress progress;
  const node::ObjectTypes types = objects::builtinTypes();
  const auto show = [&](std::string_view label, float share) { progress.show(label, share); };
  if (prepareWorld(scene, types.backends, progress, stop.token())) {
    const node::LoadedScene loaded = node::loadScene(scene, types.backends);
    if (!walk) walk = roundWalk(loaded.layout);
    if (options.exact) {
      report.exact =
          measureExactQuality(scene, types, gl, *walk, options.seconds, options.size, options.shed, show, stop.token());
    } else {
      WalkWorld world(loaded, types, gl, show);
      measureInto(report, world, *walk, options, progress, stop.token());
    }
  }
  progress.finish();
  report.interrupted = stop.token().stop_requested();
  if (options.json) {
    std::fputs(jsonOf(report, options).c_str(), stdout);
  } else {
    printText(report, options);
  }
  return 0;
}

}  // namespace grove::cli
