#include "cli/bench/amortize/bench_amortize_run.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/log.h"
#include "gl/workers.h"
#include "measure/thread_times.h"
#include "node/object_types.h"
#include "objects/builtin.h"
#include "pipeline/clocks.h"
#include "stream/load/load_report.h"
#include "stream/session/headless_session.h"
#include "stream/session/stroll.h"

namespace grove::cli {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kInputPeriod{16};
constexpr double kMaxWarmUp = 4.0;   ///< seconds
constexpr double kPatience = 180.0;  ///< seconds without a further world getting ready

std::string described(const AmortizeRun& run) {
  return std::to_string(run.users) + (run.users == 1 ? " visitor, " : " visitors, ") +
         (run.privateWorlds ? "private" : "shared");
}

/// How worlds are served in a measurement.
stream::HostOptions hostOptions(const AmortizeRun& run) {
  stream::HostOptions options;
  options.deadlineSeconds = stream::HostOptions::kNoHurry;
  options.framesPerSecond = static_cast<int>(kNominalFps);
  options.maxVisitors = run.users;
  options.privateWorlds = run.privateWorlds;
  options.makeTransport = node::transportFactory(run.transport);
  return options;
}

/// Everything of a server but its sockets.
struct ServedWorld {
  ServedWorld(const world::Scene& scene, const gl::ShaderLibrary& shaders, const AmortizeRun& run)
      : gl(gl::ContextKind::kAuto, shaders),
        host(node::loadScene(scene, types.backends), types, gl, hostOptions(run), [](std::string_view, float) {}) {}

  const node::ObjectTypes types = objects::builtinTypes();
  gl::Workers gl;
  stream::Host host;
};

/// One who walks about as the visitors of `grove load` do.
class Walker {
 public:
  Walker(stream::Host& host, int index, const AmortizeRun& run)
      : index_(index),
        session_(host, "Walker " + std::to_string(index + 1), run.width, run.height,
                 [seen = seen_](const stream::FrameHeader& frame) {
                   const std::lock_guard lock(seen->mutex);
                   seen->latency.shown(frame.lastInput, pipeline::wallSeconds(), seen->latencies);
                 }),
        yaw_(session_.welcome().yaw) {}

  void walk(double now) {
    if (!walksSince_) walksSince_ = now;
    const world::Input input = stream::stroll(index_, yaw_, now - *walksSince_);
    const std::lock_guard lock(seen_->mutex);
    seen_->latency.sent(session_.control(input.keys, input.yaw, input.pitch), pipeline::wallSeconds());
  }

  [[nodiscard]] std::uint64_t frames() const { return session_.framesReceived(); }

  void beginCounting() {
    const std::lock_guard lock(seen_->mutex);
    seen_->latencies.clear();
    framesBefore_ = frames();
  }
  [[nodiscard]] std::uint64_t framesCounted() const { return frames() - framesBefore_; }
  [[nodiscard]] std::vector<float> latencies() const {
    const std::lock_guard lock(seen_->mutex);
    return seen_->latencies;
  }

 private:
  /// Outlives the walker for as long as a worker still delivers.
  struct Seen {
    std::mutex mutex;
    stream::InputLatency latency;
    std::vector<float> latencies;
  };
  const int index_;
  const std::shared_ptr<Seen> seen_ = std::make_shared<Seen>();
  stream::HeadlessSession session_;
  const float yaw_;
  std::optional<double> walksSince_;
  std::uint64_t framesBefore_ = 0;
};

using Walkers = std::vector<std::unique_ptr<Walker>>;

/// Waits for the first frame of everybody; false if it was stopped. In private mode every world takes seconds.
bool everybodySees(const Walkers& walkers, const AmortizeRun& run, const std::stop_token& stop) {
  std::ptrdiff_t reported = 0;
  double since = pipeline::wallSeconds();
  while (!stop.stop_requested()) {
    const auto ready = std::ranges::count_if(walkers, [](const auto& walker) { return walker->frames() > 0; });
    if (ready == std::ssize(walkers)) return true;
    if (ready != reported) {
      reported = ready;
      since = pipeline::wallSeconds();
      if (run.privateWorlds) {
        log::info(described(run) + ": " + std::to_string(ready) + " of " + std::to_string(run.users) +
                  " worlds are ready");
      }
    }
    if (pipeline::wallSeconds() - since > kPatience) {
      throw EnvironmentError("a visitor gets no frame", described(run), "the log may tell why");
    }
    std::this_thread::sleep_for(milliseconds(20));
  }
  return false;
}

/// Everybody walks until `done`; false if it was stopped.
template <class Condition>
bool walkUntil(const Walkers& walkers, double begin, const std::stop_token& stop, Condition done) {
  while (!done()) {
    if (stop.stop_requested()) return false;
    for (const auto& walker : walkers) walker->walk(pipeline::wallSeconds() - begin);
    std::this_thread::sleep_for(kInputPeriod);
  }
  return true;
}

double stageSeconds(const measure::Reading& before, const measure::Reading& after) {
  std::int64_t nanoseconds = 0;
  for (const auto& [key, total] : after.costs) nanoseconds += total.cpuNanoseconds;
  for (const auto& [key, total] : before.costs) nanoseconds -= total.cpuNanoseconds;
  return static_cast<double>(nanoseconds) * 1.0e-9;
}

}  // namespace

double AmortizeRow::coresNeeded() const {
  const measure::FrameCost all = cost();
  const double reported = (copies() * all.acrossUser + users * all.perUser()) * 1e-3 * kNominalFps;
  return reported + (cpuCores - stageCores) * kNominalFps / std::max(1e-3, fps());
}

std::optional<AmortizeRow> runAmortize(const world::Scene& scene, const gl::ShaderLibrary& shaders,
                                       const AmortizeRun& run, const std::stop_token& stop) {
  log::info(described(run) + ": preparing");
  measure::returnFreedMemory();
  ServedWorld served(scene, shaders, run);
  Walkers walkers;
  for (int i = 0; i < run.users; ++i) walkers.push_back(std::make_unique<Walker>(served.host, i, run));
  if (!everybodySees(walkers, run, stop)) return std::nullopt;

  const double begin = pipeline::wallSeconds();
  const double warm = begin + std::min(kMaxWarmUp, 2.0 * run.seconds);
  if (!walkUntil(walkers, begin, stop, [&] { return pipeline::wallSeconds() >= warm; })) return std::nullopt;

  log::info(described(run) + ": measuring");
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
  row.privateWorlds = run.privateWorlds;
  row.seconds = after.seconds - before.seconds;
  row.traffic = served.host.traffic() - trafficBefore;
  std::uint64_t min = walkers.front()->framesCounted();
  std::vector<float> latencies;
  for (const auto& walker : walkers) {
    row.frames += static_cast<double>(walker->framesCounted());
    min = std::min(min, walker->framesCounted());
    const auto more = walker->latencies();
    latencies.insert(latencies.end(), more.begin(), more.end());
  }
  row.fpsMin = static_cast<double>(min) / row.seconds;
  row.latencyP50 = stream::percentile(latencies, 0.5);
  row.latencyP99 = stream::percentile(std::move(latencies), 0.99);
  measure::Served who;
  who.visitors = run.users;
  who.frames = row.frames;
  who.copies = row.copies();
  who.framesPerSecond = kNominalFps;
  row.costs = measure::frameCosts(before, after, who);
  row.memory = measure::memoryShares(served.host.memory(), run.users, row.copies());
  for (const auto& [key, total] : served.host.memory().totals()) row.reportedBytes += static_cast<double>(total.bytes);
  row.process = measure::MemoryUse::read();
  row.cpuCores = (after.processSeconds - before.processSeconds) / row.seconds;
  row.stageCores = stageSeconds(before, after) / row.seconds;
  row.driverCores = threadsAfter.secondsSince(threadsBefore, measure::kDriverThreads) / row.seconds;
  return row;
}

}  // namespace grove::cli
