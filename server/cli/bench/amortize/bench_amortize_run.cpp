#include "cli/bench/amortize/bench_amortize_run.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include "base/error.h"
#include "cli/bench/walkers.h"
#include "gl/workers.h"
#include "measure/thread_times.h"
#include "node/local/local_world.h"
#include "node/object_types.h"
#include "objects/builtin.h"
#include "pipeline/clocks.h"

namespace grove::cli {
namespace {

using std::chrono::milliseconds;

constexpr double kPatience = 180.0;  ///< seconds until everybody sees a frame

/// How worlds are served in a measurement.
stream::HostOptions hostOptions(const AmortizeRun& run) {
  stream::HostOptions options;
  options.deadlineSeconds = stream::HostOptions::kNoHurry;
  options.framesPerSecond = static_cast<int>(kNominalFps);
  options.maxVisitors = run.users;
  return options;
}

/// Everything of a server but its sockets.
struct ServedWorld {
  ServedWorld(const world::Scene& scene, const AmortizeRun& run)
      : gl(gl::ContextKind::kAuto, shaders),
        host(node::localWorld(node::loadScene(scene, types.backends), types.backends, gl,
                              node::transportFactory(run.transport)),
             types.frontends, hostOptions(run), [](std::string_view, float) {}) {}

  const node::ObjectTypes types = objects::builtinTypes();
  const gl::ShaderLibrary shaders;
  gl::Workers gl;
  stream::Host host;
};

/// Waits for the first frame of everybody; false if it was stopped.
bool everybodySees(const Walkers& walkers, const std::stop_token& stop) {
  const double since = pipeline::wallSeconds();
  while (!stop.stop_requested()) {
    if (std::ranges::all_of(walkers, [](const auto& walker) { return walker->frames() > 0; })) return true;
    if (pipeline::wallSeconds() - since > kPatience) {
      throw EnvironmentError("a visitor gets no frame", "grove bench amortize", "the log may have the reason");
    }
    std::this_thread::sleep_for(milliseconds(20));
  }
  return false;
}

/// Frames and latencies of the walkers.
void addWalkers(AmortizeRow& row, const Walkers& walkers) {
  std::uint64_t min = walkers.front()->framesCounted();
  for (const auto& walker : walkers) {
    row.frames += static_cast<double>(walker->framesCounted());
    min = std::min(min, walker->framesCounted());
    const auto more = walker->latencies();
    row.latencies.insert(row.latencies.end(), more.begin(), more.end());
  }
  row.fpsMin = static_cast<double>(min) / row.seconds;
}

double stageSeconds(const measure::Reading& before, const measure::Reading& after) {
  std::int64_t nanoseconds = 0;
  for (const auto& [key, total] : after.costs) nanoseconds += total.cpuNanoseconds;
  for (const auto& [key, total] : before.costs) nanoseconds -= total.cpuNanoseconds;
  return static_cast<double>(nanoseconds) * 1.0e-9;
}

double tickMilliseconds(const measure::Reading& before, const measure::Reading& after) {
  const auto totalOf = [](const measure::Reading& reading) {
    const auto found = reading.costs.find({"Simulation Tick", "fluid"});
    return found == reading.costs.end() ? pipeline::StageTotal{} : found->second;
  };
  const pipeline::StageTotal now = totalOf(after);
  const pipeline::StageTotal past = totalOf(before);
  if (now.runs == past.runs) return 0.0;
  return 1.0e-6 * static_cast<double>(now.cpuNanoseconds - past.cpuNanoseconds) /
         static_cast<double>(now.runs - past.runs);
}

}  // namespace

std::optional<AmortizeRow> runAmortize(const world::Scene& scene, const AmortizeRun& run,
                                       const std::function<bool()>& arrive, const std::stop_token& stop) {
  ServedWorld served(scene, run);
  const auto steering = [&run](int index, float yaw, double seconds) {
    return controlsOn(run.course, run.firstVisitor + index, yaw, seconds);
  };
  const Walkers walkers = makeWalkers(served.host, run.users, {run.size, run.codec}, steering);
  if (!everybodySees(walkers, stop) || !arrive()) return std::nullopt;

  const double begin = pipeline::wallSeconds();
  const double warm = begin + (run.course == Course::kApart ? kMaxWarmUp : std::min(kMaxWarmUp, 2.0 * run.seconds));
  if (!walkUntil(walkers, begin, stop, [&] { return pipeline::wallSeconds() >= warm; })) return std::nullopt;

  for (const auto& walker : walkers) walker->beginCounting();
  const measure::ThreadTimes threadsBefore = measure::ThreadTimes::read();
  const node::LinkTraffic trafficBefore = served.host.traffic();
  const measure::Reading before = measure::Reading::of(served.host.timeline());
  const auto enough = [&] {
    if (run.frames == 0) return pipeline::wallSeconds() >= warm + run.seconds;
    const auto all = static_cast<std::uint64_t>(run.frames);
    return std::ranges::all_of(walkers, [&](const auto& walker) { return walker->framesCounted() >= all; });
  };
  if (!walkUntil(walkers, begin, stop, enough)) return std::nullopt;
  const measure::Reading after = measure::Reading::of(served.host.timeline());
  const measure::ThreadTimes threadsAfter = measure::ThreadTimes::read();

  AmortizeRow row;
  row.users = run.users;
  row.course = run.course;
  row.codec = walkers.front()->codec();
  row.seconds = after.seconds - before.seconds;
  row.traffic = served.host.traffic() - trafficBefore;
  addWalkers(row, walkers);
  row.costs = measure::frameCosts(before, after, {static_cast<double>(run.users), row.frames});
  row.memory = measure::memoryShares(served.host.memory(), run.users);
  row.reuse = measure::sum(measure::reuseBetween(before, after));
  row.tick = tickMilliseconds(before, after);
  for (const auto& [key, total] : served.host.memory().totals()) row.reportedBytes += static_cast<double>(total.bytes);
  row.process = measure::MemoryUse::read();
  row.cpuCores = (after.processSeconds - before.processSeconds) / row.seconds;
  row.stageCores = stageSeconds(before, after) / row.seconds;
  row.driverCores = threadsAfter.secondsSince(threadsBefore, measure::kDriverThreads) / row.seconds;
  return row;
}

}  // namespace grove::cli
