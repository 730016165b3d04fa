#include "cli/bench/pipeline/bench_pipeline.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <stop_token>
#include <utility>

#include "base/error.h"
#include "cli/bench/link_report.h"
#include "cli/bench/picture_size.h"
#include "cli/bench/walkers.h"
#include "cli/figures.h"
#include "cli/prepare/prepare_world.h"
#include "cli/prepare/progress.h"
#include "cli/stop_on_signal.h"
#include "gl/shader_library.h"
#include "gl/workers.h"
#include "measure/chrome_trace.h"
#include "measure/percentile.h"
#include "measure/utilisation.h"
#include "node/local/local_world.h"
#include "node/object_types.h"
#include "objects/builtin.h"
#include "pipeline/clocks.h"
#include "stream/session/host.h"
#include "world/scenes/scene_file.h"

namespace grove::cli {
namespace {

using nlohmann::ordered_json;

constexpr double kWarmUpSeconds = 2.0;
/// More than any machine reaches with a relevant scene, so that the frame clock is not the limit.
constexpr int kFramesPerSecond = 240;
constexpr std::size_t kTimelineEvents = std::size_t{1} << 20U;

/// Each visitor walks in a separate circle.
world::Input circle(int index, float yaw, double seconds) {
  const double turn = 0.4 * seconds + 1.6 * static_cast<double>(index);
  return {.keys = world::kForward, .yaw = yaw + static_cast<float>(turn)};
}

/// Measurements with one number of frames in flight.
struct Row {
  int framesInFlight = 0;
  measure::Window window;
  std::vector<pipeline::TimelineEvent> events;  ///< including those before the window
  std::vector<measure::FrameSpan> frames;
  std::map<std::string, measure::StageUse> stages;
  double framesPerSecond = 0.0;  ///< of a visitor
  double overlap = 0.0;
  node::LinkTraffic traffic;

  [[nodiscard]] double latency(double share) const {
    std::vector<double> latencies;
    for (const measure::FrameSpan& frame : frames) latencies.push_back(frame.milliseconds());
    return measure::percentile(std::move(latencies), share);
  }
};

Row evaluate(int framesInFlight, int users, const measure::Window& window,
             std::vector<pipeline::TimelineEvent> events) {
  Row row{framesInFlight, window, std::move(events), {}, {}, 0.0, 0.0, {}};
  // The timeline has dropped the oldest runs.
  if (row.events.size() == kTimelineEvents) {
    row.window.beginNanoseconds = std::max(window.beginNanoseconds, row.events.front().beginNanoseconds);
  }
  row.frames = measure::deliveredFrames(row.events, row.window);
  row.stages = measure::stageUse(row.events, row.window);
  row.framesPerSecond = static_cast<double>(row.frames.size()) / row.window.seconds() / users;
  row.overlap = measure::overlap(row.frames, row.window, users);
  return row;
}

/// Returns nothing if it was stopped before it had a measurement.
std::optional<Row> measureRow(const BenchPipelineOptions& options, int framesInFlight, stream::Host& host,
                              const std::stop_token& stop) {
  const Walkers walkers = makeWalkers(host, options.users, {options.size}, circle);
  const double begin = pipeline::wallSeconds();
  const auto walkFor = [&](double seconds) {
    const double end = pipeline::wallSeconds() + seconds;
    return walkUntil(walkers, begin, stop, [end] { return pipeline::wallSeconds() >= end; });
  };
  if (!walkFor(kWarmUpSeconds)) return std::nullopt;
  measure::Window window;
  window.beginNanoseconds = pipeline::wallNanoseconds();
  const node::LinkTraffic before = host.traffic();
  (void)walkFor(options.seconds);  // measurements until a signal count
  window.endNanoseconds = pipeline::wallNanoseconds();
  Row row = evaluate(framesInFlight, options.users, window, host.timeline().events());
  row.traffic = host.traffic() - before;
  return row;
}

ordered_json toJson(const measure::Use& use) {
  return {{"runs", use.runs},
          {"wall_ms_per_run", rounded(use.wallMillisecondsPerRun, 3)},
          {"cpu_ms_per_run", rounded(use.cpuMillisecondsPerRun, 3)},
          {"utilisation", rounded(use.utilisation, 3)}};
}

ordered_json toJson(const Row& row, int users) {
  ordered_json stages = ordered_json::object();
  for (const auto& [name, stage] : row.stages) {
    ordered_json& entry = stages[name] = toJson(stage.all);
    for (const auto& [type, use] : stage.types) entry["types"][type] = toJson(use);
  }
  return {{"frames_in_flight", row.framesInFlight},
          {"seconds", rounded(row.window.seconds(), 3)},
          {"frames", row.frames.size()},
          {"frames_per_second", rounded(row.framesPerSecond, 3)},
          {"latency_ms", {{"p50", rounded(row.latency(0.5), 3)}, {"p99", rounded(row.latency(0.99), 3)}}},
          {"overlap", rounded(row.overlap, 3)},
          {"bottleneck", measure::bottleneck(row.stages)},
          {"link", linkJson(row.traffic, row.window.seconds(), users)},
          {"stages", std::move(stages)}};
}

void print(const char* indent, const std::string& name, const measure::Use& use) {
  const int width = 24 - static_cast<int>(std::string_view(indent).size());
  const auto bar = static_cast<std::size_t>(std::lround(use.utilisation * 20.0));
  std::printf("%s%-*s %8llu %9.3f %9.3f %5.0f %% %s\n", indent, width, name.c_str(),
              static_cast<unsigned long long>(use.runs), use.wallMillisecondsPerRun, use.cpuMillisecondsPerRun,
              use.utilisation * 100.0, std::string(bar, '#').c_str());
}

void print(const Row& row) {
  std::printf(
      "\n%d in flight: %.1f frames/s for each visitor, latency %.1f ms (p99 %.1f), %.2f frames of a visitor in "
      "progress\n",
      row.framesInFlight, row.framesPerSecond, row.latency(0.5), row.latency(0.99), row.overlap);
  std::printf("  %-22s %8s %9s %9s %7s\n", "stage", "runs", "wall ms", "CPU ms", "active");
  for (const auto& [name, stage] : row.stages) {
    print("  ", name, stage.all);
    for (const auto& [type, use] : stage.types) print("    ", type, use);
  }
  std::printf("  bottleneck: %s\n", measure::bottleneck(row.stages).c_str());
}

void report(const BenchPipelineOptions& options, const world::Scene& scene, const std::vector<Row>& rows,
            bool interrupted) {
  if (!options.json) {
    std::printf("%s, %d visitors, %s, %u cores\n", scene.name.c_str(), options.users, nameOf(options.size).c_str(),
                std::thread::hardware_concurrency());
    for (const Row& row : rows) print(row);
    if (interrupted) std::puts("\ninterrupted: these figures are incomplete");
    return;
  }
  ordered_json document = {{"scene", scene.name},
                           {"users", options.users},
                           {"size", nameOf(options.size)},
                           {"transport", transportName(options.transport)},
                           {"cores", std::thread::hardware_concurrency()},
                           {"frames_per_second_limit", kFramesPerSecond},
                           {"interrupted", interrupted},
                           {"rows", ordered_json::array()}};
  for (const Row& row : rows) document["rows"].push_back(toJson(row, options.users));
  std::printf("%s\n", document.dump(2).c_str());
}

/// The trace's file, opened before the measurement, so that a bad path fails early.
class TraceFile {
 public:
  explicit TraceFile(const std::string& path) : path_(path), file_(path, std::ios::binary) { check(); }

  void write(const std::vector<Row>& rows) {
    std::vector<std::vector<pipeline::TimelineEvent>> measured;
    for (const Row& row : rows) {
      std::erase_if(measured.emplace_back(row.events), [&](const pipeline::TimelineEvent& event) {
        return event.beginNanoseconds < row.window.beginNanoseconds ||
               event.beginNanoseconds > row.window.endNanoseconds;
      });
    }
    std::vector<measure::TraceSection> sections;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const int count = rows[i].framesInFlight;
      sections.push_back(
          {std::to_string(count) + (count == 1 ? " frame in flight" : " frames in flight"), measured[i]});
    }
    file_ << measure::chromeTrace(sections) << std::flush;
    check();
  }

 private:
  void check() const {
    if (!file_) throw EnvironmentError("cannot write the trace", path_, "name a file that can be written");
  }

  const std::string path_;
  std::ofstream file_;
};

}  // namespace

int runBenchPipeline(const BenchPipelineOptions& options) {
  if (std::set<int>(options.framesInFlight.begin(), options.framesInFlight.end()).size() !=
      options.framesInFlight.size()) {
    std::fputs("bench pipeline: --frames-in-flight has a number twice\n", stderr);
    return 2;
  }
  std::optional<TraceFile> trace;
  if (options.trace) trace.emplace(*options.trace);

  const StopOnSignal stop;
  const world::Scene scene = openScene(options.scene);
  const gl::ShaderLibrary shaders;
  gl::Workers gl(gl::ContextKind::kAuto, shaders);
  Progress progress;
  const node::ObjectTypes types = objects::builtinTypes();
  const bool prepared = prepareWorld(scene, types.backends, progress, stop.token());
  std::vector<Row> rows;
  for (const int framesInFlight : options.framesInFlight) {
    if (!prepared || stop.token().stop_requested()) break;
    stream::HostOptions hosting;
    hosting.deadlineSeconds = stream::HostOptions::kNoHurry;
    hosting.framesInFlight = framesInFlight;
    hosting.framesPerSecond = kFramesPerSecond;
    hosting.maxVisitors = options.users;
    hosting.timelineEvents = kTimelineEvents;
    stream::Host host(node::localWorld(node::loadScene(scene, types.backends), types.backends, gl,
                                       node::transportFactory(options.transport)),
                      types.frontends, hosting,
                      [&](std::string_view label, float share) { progress.show(label, share); });
    progress.finish();
    if (auto row = measureRow(options, framesInFlight, host, stop.token())) rows.push_back(std::move(*row));
  }
  if (trace) trace->write(rows);
  report(options, scene, rows, stop.token().stop_requested());
  return 0;
}

}  // namespace grove::cli
