#include "cli/bench/warp/bench_warp.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/bench/walk/fire_walks.h"
#include "cli/bench/walk/walk_world.h"
#include "cli/bench/warp/film.h"
#include "cli/bench/warp/late_page.h"
#include "cli/bench/warp/sent_walk.h"
#include "cli/figures.h"
#include "cli/prepare/prepare_world.h"
#include "cli/prepare/progress.h"
#include "cli/stop_on_signal.h"
#include "gl/shader_library.h"
#include "measure/processor.h"
#include "objects/builtin.h"
#include "world/scenes/scene_file.h"
#include "world/walk.h"

namespace grove::cli {
namespace {

using nlohmann::ordered_json;

void print(const BenchWarpOptions& options, const WarpReport& report, bool interrupted) {
  std::printf("%s over a round trip of %.0f ms, %d pictures a second, %zu frames of the display, %s\n",
              nameOf(options.size).c_str(), options.delay, options.pictures, report.frames,
              measure::processorName().c_str());
  std::printf("%-24s %8s %8s\n", "PSNR, dB", "mean", "worst");
  const auto row = [](const char* name, const Errors& errors) {
    std::printf("%-24s %8.2f %8.2f\n", name, errors.mean(), errors.worst());
  };
  row("as it comes", report.none);
  row("turned (late look)", report.turned);
  row("moved (late walk)", report.moved);
  std::printf("depths: %.1f %% more bits, %.2f ms more CPU per frame\n", 100.0 * report.bitsMore(),
              report.cpuMilliseconds);
  if (interrupted) std::puts("\ninterrupted: these figures are incomplete");
}

void printJson(const BenchWarpOptions& options, const WarpReport& report, bool interrupted) {
  const auto psnr = [](const Errors& errors) {
    return ordered_json{{"mean", rounded(errors.mean(), 2)}, {"worst", rounded(errors.worst(), 2)}};
  };
  const ordered_json json{{"walk", options.walk.value_or(kRoundWalkName)},
                          {"size", nameOf(options.size)},
                          {"delay_ms", options.delay},
                          {"pictures_per_second", options.pictures},
                          {"lines", options.lines > 0 ? options.lines : options.size.height},
                          {"frames", report.frames},
                          {"psnr_db", psnr(report.moved)},
                          {"psnr_db_turned", psnr(report.turned)},
                          {"psnr_db_as_it_comes", psnr(report.none)},
                          {"bits_more", rounded(report.bitsMore(), 4)},
                          {"cpu_ms_more", rounded(report.cpuMilliseconds, 3)},
                          {"processor", measure::processorName()},
                          {"interrupted", interrupted}};
  std::printf("%s\n", json.dump(2).c_str());
}

}  // namespace

int runBenchWarp(const BenchWarpOptions& options) {
  std::optional<world::Walk> walk;
  if (options.walk) walk = world::loadWalk(*options.walk);
  std::optional<Film> film;
  if (!options.film.empty()) film.emplace(options.film, options.size);
  const StopOnSignal stop;
  const world::Scene scene = openScene(std::nullopt);
  const gl::ShaderLibrary shaders;
  gl::Workers gl(gl::ContextKind::kAuto, shaders);
  Progress progress;
  const node::ObjectTypes types = objects::builtinTypes();
  WarpReport report;
  if (prepareWorld(scene, types.backends, progress, stop.token())) {
    const node::LoadedScene loaded = node::loadScene(scene, types.backends);
    if (!walk) walk = roundWalk(loaded.layout);
    std::optional<WalkWorld> world;
    world.emplace(loaded, types, gl, [&](std::string_view label, float share) { progress.show(label, share); });
    progress.show("drawing a walk", 0.0F);
    SentWalk frames = drawSentWalk(*world, *walk, options, stop.token());
    world.reset();
    progress.finish();
    report = showLate(frames, options.delay, film ? &*film : nullptr, stop.token());
  }
  const bool interrupted = stop.token().stop_requested();
  options.json ? printJson(options, report, interrupted) : print(options, report, interrupted);
  return 0;
}

}  // namespace grove::cli
