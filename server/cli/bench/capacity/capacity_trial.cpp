#include "cli/bench/capacity/capacity_trial.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "cli/bench/capacity/server_process.h"
#include "pipeline/clocks.h"
#include "stream/load/load_client.h"

namespace grove::cli {
namespace {

constexpr double kFps = 29.0;                   ///< minimum for the median visitor
constexpr double kLatencyMilliseconds = 100.0;  ///< p99
constexpr double kEntryInterval = 1.0;          ///< seconds from one visitor's entry to the next

/// Waits until a time of pipeline::wallSeconds(); returns false if it was stopped.
bool waitUntil(double time, const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any changed;
  std::unique_lock lock(mutex);
  const std::chrono::duration<double> left(time - pipeline::wallSeconds());
  (void)changed.wait_for(lock, stop, left, [] { return false; });
  return !stop.stop_requested();
}

class Trial {
 public:
  Trial(const CapacityPlan& plan, int visitors, bool privateWorlds)
      : plan_(plan), visitors_(visitors), privateWorlds_(privateWorlds), outcomes_(static_cast<std::size_t>(visitors)) {
    std::vector<std::string> options{"--max-visitors", std::to_string(visitors), "--visitors-per-address",
                                     std::to_string(visitors)};
    if (plan.scene) options.insert(options.end(), {"--scene", *plan.scene});
    for (int i = 0; i < (privateWorlds ? visitors : 1); ++i) servers_.emplace_back(plan.program, options);
  }

  std::optional<CapacityTrial> run(const std::stop_token& stop) {
    std::vector<int> ports;
    for (ServerProcess& server : servers_) {
      const std::optional<int> port = server.awaitPort();
      if (stop.stop_requested()) return std::nullopt;
      if (!port) throw EnvironmentError("ends before its world is ready", "grove serve", "stderr has the reason");
      ports.push_back(*port);
    }
    const double entry = pipeline::wallSeconds();
    const double begin = entry + visitors_ * kEntryInterval + plan_.warmUp;
    std::vector<std::jthread> clients;
    for (int i = 0; i < visitors_; ++i) {
      const int port = ports[privateWorlds_ ? static_cast<std::size_t>(i) : 0];
      clients.emplace_back([this, i, port, entry, begin, stop] {
        if (waitUntil(entry + i * kEntryInterval, stop)) visit(i, port, begin);
      });
    }
    CapacityTrial result{.visitors = visitors_, .privateWorlds = privateWorlds_, .load = {}};
    if (!measureServers(begin, result, stop)) {
      servers_.clear();  // ends the clients, too
      return std::nullopt;
    }
    clients.clear();
    result.load = summarise(together());
    return result;
  }

 private:
  /// One thread per visitor.
  void visit(int visitor, int port, double begin) noexcept {
    stream::LoadOutcome& outcome = outcomes_[static_cast<std::size_t>(visitor)];
    try {
      outcome = stream::runLoadClients({"127.0.0.1", port}, {.sessions = 1,
                                                             .firstVisitor = visitor,
                                                             .countFrom = begin,
                                                             .seconds = plan_.seconds,
                                                             .width = plan_.size.width,
                                                             .height = plan_.size.height,
                                                             .codecs = {plan_.codec}});
    } catch (const std::exception& e) {
      outcome.errors.emplace_back(e.what());
    }
  }

  bool measureServers(double begin, CapacityTrial& result, const std::stop_token& stop) const {
    if (!waitUntil(begin, stop)) return false;
    const double before = cpuSeconds();
    const double since = pipeline::wallSeconds();
    if (!waitUntil(begin + plan_.seconds, stop)) return false;
    result.cpuCores = (cpuSeconds() - before) / (pipeline::wallSeconds() - since);
    for (const ServerProcess& server : servers_) result.bytes += server.proportionalBytes();
    return true;
  }

  [[nodiscard]] double cpuSeconds() const {
    double sum = 0.0;
    for (const ServerProcess& server : servers_) sum += server.cpuSeconds();
    return sum;
  }

  [[nodiscard]] stream::LoadOutcome together() const {
    stream::LoadOutcome all{.letIn = {}, .seconds = plan_.seconds, .errors = {}};
    for (const stream::LoadOutcome& one : outcomes_) {
      all.letIn.insert(all.letIn.end(), one.letIn.begin(), one.letIn.end());
      all.errors.insert(all.errors.end(), one.errors.begin(), one.errors.end());
    }
    return all;
  }

  const CapacityPlan& plan_;
  const int visitors_;
  const bool privateWorlds_;
  std::vector<stream::LoadOutcome> outcomes_;  ///< by visitor
  std::deque<ServerProcess> servers_;
};

}  // namespace

bool CapacityTrial::isServed(const PictureSize& size) const {
  return load.sessions == visitors && load.errors.empty() && load.fpsP50 >= kFps &&
         load.latencyP99Milliseconds <= kLatencyMilliseconds && load.linesMin >= size.height;
}

double CapacityTrial::cpuMillisecondsPerFrame() const {
  return load.frames == 0 ? 0.0 : 1e3 * cpuCores * load.seconds / static_cast<double>(load.frames);
}

std::optional<CapacityTrial> runCapacityTrial(const CapacityPlan& plan, int visitors, bool privateWorlds,
                                              const std::stop_token& stop) {
  std::optional<CapacityTrial> result = Trial(plan, visitors, privateWorlds).run(stop);
  if (!result) return result;
  for (const std::string& error : result->load.errors) log::warning(error);
  return result;
}

}  // namespace grove::cli
