#include "cli/bench/encode/bench_encode.h"

#include <cmath>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "cli/bench/encode/encode_trial.h"
#include "cli/bench/encode/kept_file.h"
#include "cli/bench/encode/kept_frames.h"
#include "cli/bench/picture_size.h"
#include "cli/bench/walk/fire_walks.h"
#include "cli/bench/walk/walk_visitor.h"
#include "cli/bench/walk/walk_world.h"
#include "cli/figures.h"
#include "cli/prepare/prepare_world.h"
#include "cli/prepare/progress.h"
#include "cli/stop_on_signal.h"
#include "gl/shader_library.h"
#include "measure/processor.h"
#include "objects/builtin.h"
#include "stream/protocol/protocol.h"
#include "stream/session/host.h"
#include "world/scenes/scene_file.h"
#include "world/walk.h"

namespace grove::cli {
namespace {

using nlohmann::ordered_json;

constexpr double kStandingSeconds = 10.0;
constexpr int kStandingKilobits = 4000;

struct TrialRow {
  std::string walk;
  std::size_t frames = 0;
  EncodeTrial trial;
};

struct EncodeReport {
  std::string size;
  std::vector<TrialRow> rows;
  bool interrupted = false;
};

std::vector<EncodeSetting> walkSettings(const stream::EncoderKind& kind, bool onlyFixed) {
  if (!kind.chained) return {{kind.make()->range().usual}};
  std::vector<EncodeSetting> settings;
  for (const int quantiser : {22, 25, 28, 31, 34}) settings.push_back({quantiser});
  if (onlyFixed) {
    // Under trees, the finer ones take more than the 3 Mbit/s at which tests/oracle compares encoders.
    for (const int quantiser : {37, 40}) settings.push_back({quantiser});
    return settings;
  }
  for (const int kilobits : {2000, 4000, 6000}) settings.push_back({std::nullopt, kilobits});
  return settings;
}

std::string settingName(const EncodeSetting& setting) {
  if (setting.quantiser) return "fixed";
  return "led, " + std::to_string(setting.kilobitsPerSecond) + " kbit/s";
}

void print(const EncodeReport& report) {
  std::printf("%s, one core of %s\n", report.size.c_str(), measure::processorName().c_str());
  std::printf("%-7s %-13s %-20s %-18s %9s %9s %9s %9s %7s %7s\n", "codec", "encoder", "walk", "setting", "quantiser",
              "CPU ms", "p99", "kbit/s", "SSIM", "lowest");
  for (const TrialRow& row : report.rows) {
    const EncodeTrial& trial = row.trial;
    std::printf("%-7s %-13s %-20s %-18s %9.1f %9.2f %9.2f %9.0f %7.4f %7.4f\n", trial.codec.c_str(),
                trial.encoder.c_str(), row.walk.c_str(), settingName(trial.setting).c_str(), trial.quantiser,
                trial.cpuMilliseconds, trial.p99Milliseconds, trial.kilobitsPerSecond, trial.ssim, trial.minSsim);
  }
  if (report.interrupted) std::puts("\ninterrupted: these figures are incomplete");
}

ordered_json toJson(const EncodeReport& report) {
  ordered_json rows = ordered_json::array();
  const std::string processor = measure::processorName();
  for (const TrialRow& row : report.rows) {
    const EncodeTrial& trial = row.trial;
    ordered_json wanted;
    if (!trial.setting.quantiser) wanted = trial.setting.kilobitsPerSecond;
    rows.push_back({{"codec", trial.codec},
                    {"encoder", trial.encoder},
                    {"walk", row.walk},
                    {"wanted_kbit_per_s", wanted},
                    {"quantiser", rounded(trial.quantiser, 2)},
                    {"frames", row.frames},
                    {"pictures", trial.pictures},
                    {"size", report.size},
                    {"processor", processor},
                    {"cpu_ms_per_frame", rounded(trial.cpuMilliseconds, 3)},
                    {"cpu_ms_mean", rounded(trial.meanMilliseconds, 3)},
                    {"p99_ms", rounded(trial.p99Milliseconds, 3)},
                    {"kbit_per_s", rounded(trial.kilobitsPerSecond, 1)},
                    {"ssim", rounded(trial.ssim, 4)},
                    {"ssim_min", rounded(trial.minSsim, 4)}});
  }
  return {{"interrupted", report.interrupted}, {"rows", std::move(rows)}};
}

/// Records the frames along the walk, 30 per second. After a stop request, returns the frames so far.
KeptFrames recordWalk(WalkWorld& world, const world::Walk& walk, double seconds, const PictureSize& size,
                      const std::stop_token& stop) {
  KeptFrames frames(size.width, size.height);
  WalkVisitor visitor(world, {.size = size});
  world.walk(
      walk, seconds, Pace::kThirtyASecond, [&](const Moment& moment) { static_cast<void>(visitor.draw(moment)); },
      [&](const Moment& moment) { frames.add(visitor.draw(moment)); }, stop);
  return frames;
}

void keepFrames(KeptFrames& frames, KeptFilm& film) {
  for (std::size_t i = 0; i < frames.count(); ++i) film.add(*frames.read(i).picture);
  film.commit();
}

/// Also writes the stream into the folder, unless it is of JPEG's pictures or a stop request made it incomplete.
EncodeTrial tryAndKeep(const stream::EncoderRegistry& encoders, const stream::EncoderKind& kind,
                       const EncodeSetting& setting, KeptFrames& frames,
                       const std::optional<std::filesystem::path>& folder, const std::stop_token& stop) {
  if (!folder || kind.codec != stream::kCodecH264) return tryEncoder(encoders, kind, setting, frames, stop);
  KeptFile file(*folder / (kind.name + "-" + std::to_string(std::lround(setting.quantiser.value())) + ".h264"));
  EncodeTrial trial = tryEncoder(encoders, kind, setting, frames, stop, [&](auto picture) { file.append(picture); });
  if (!stop.stop_requested()) file.commit();
  return trial;
}

}  // namespace

int runBenchEncode(const BenchEncodeOptions& options) {
  std::optional<world::Walk> walk;
  if (options.walk) walk = world::loadWalk(*options.walk);
  std::optional<KeptFilm> film;
  if (options.keep) film.emplace(*options.keep / "frames.y4m", options.size);

  const StopOnSignal stop;
  EncodeReport report;
  report.size = nameOf(options.size);
  const world::Scene scene = openScene(std::nullopt);
  const gl::ShaderLibrary shaders;
  gl::Workers gl(gl::ContextKind::kAuto, shaders);
  Progress progress;
  const node::ObjectTypes types = objects::builtinTypes();
  if (prepareWorld(scene, types.backends, progress, stop.token())) {
    const node::LoadedScene loaded = node::loadScene(scene, types.backends);
    if (!walk) walk = roundWalk(loaded.layout);
    const stream::EncoderRegistry encoders = stream::builtinEncoders(stream::HostOptions().jpegQuality);
    // Draws all frames first and encodes them after the world is destroyed, so that nothing else uses the processor's
    // caches.
    std::optional<WalkWorld> world;
    world.emplace(loaded, types, gl, [&](std::string_view label, float share) { progress.show(label, share); });
    progress.show("drawing a walk", 0.0F);
    KeptFrames moving = recordWalk(*world, *walk, options.seconds, options.size, stop.token());
    std::optional<KeptFrames> still;
    if (!film) still = recordWalk(*world, standingWalk(loaded.layout), kStandingSeconds, options.size, stop.token());
    world.reset();
    progress.finish();
    if (film && !stop.token().stop_requested()) keepFrames(moving, *film);
    const auto measure = [&](const stream::EncoderKind& kind, const EncodeSetting& setting, const std::string& name,
                             KeptFrames& frames) {
      if (stop.token().stop_requested() || frames.count() == 0) return;
      report.rows.push_back(
          {name, frames.count(), tryAndKeep(encoders, kind, setting, frames, options.keep, stop.token())});
    };
    for (const stream::EncoderKind& kind : encoders.kinds()) {
      const std::string name = options.walk.value_or(kRoundWalkName);
      for (const EncodeSetting& setting : walkSettings(kind, film.has_value())) measure(kind, setting, name, moving);
    }
    for (const stream::EncoderKind& kind : encoders.kinds()) {
      if (still) measure(kind, {std::nullopt, kStandingKilobits}, "before the fire", *still);
    }
  }
  report.interrupted = stop.token().stop_requested();
  if (options.json) {
    std::printf("%s\n", toJson(report).dump(2).c_str());
  } else {
    print(report);
  }
  return 0;
}

}  // namespace grove::cli
