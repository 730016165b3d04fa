#include "cli/bench/capacity/bench_capacity.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "base/log.h"
#include "cli/bench/capacity/capacity_law.h"
#include "cli/bench/capacity/capacity_search.h"
#include "cli/bench/codec_names.h"
#include "cli/figures.h"
#include "cli/prepare/prepare_world.h"
#include "cli/prepare/progress.h"
#include "cli/stop_on_signal.h"
#include "measure/processor.h"
#include "objects/builtin_backends.h"

namespace grove::cli {
namespace {

using nlohmann::ordered_json;

constexpr int kMaxVisitors = 64;

struct CapacityResult {
  int shared = 0;
  int unshared = 0;  ///< private visitors
  std::vector<CapacityTrial> trials;
};

const char* modeOf(bool privateWorlds) { return privateWorlds ? "private" : "shared"; }

std::optional<int> search(const CapacityPlan& plan, bool privateWorlds, std::vector<CapacityTrial>& trials,
                          const std::stop_token& stop) {
  const auto serves = [&](int visitors) -> std::optional<bool> {
    const std::optional<CapacityTrial> trial = runCapacityTrial(plan, visitors, privateWorlds, stop);
    if (!trial) return std::nullopt;
    trials.push_back(*trial);
    const bool isServed = trial->isServed(plan.size);
    log::info(std::to_string(visitors) + " visitors, " + modeOf(privateWorlds) + ": " +
              (isServed ? "served" : "not served"));
    return isServed;
  };
  return findCapacity(serves, kMaxVisitors);
}

/// Bakes first, so that no trial begins with a bake.
std::optional<CapacityResult> measureCapacity(const CapacityPlan& plan, const std::stop_token& stop) {
  Progress progress;
  const bool prepared = prepareWorld(openScene(plan.scene), objects::builtinBackends(), progress, stop);
  progress.finish();
  if (!prepared) return std::nullopt;
  CapacityResult result;
  const std::optional<int> shared = search(plan, false, result.trials, stop);
  if (!shared) return std::nullopt;
  const std::optional<int> unshared = search(plan, true, result.trials, stop);
  if (!unshared) return std::nullopt;
  result.shared = *shared;
  result.unshared = *unshared;
  return result;
}

ordered_json jsonOf(const CapacityTrial& trial, const PictureSize& size) {
  const stream::LoadReport& load = trial.load;
  return {{"mode", modeOf(trial.privateWorlds)},
          {"visitors", trial.visitors},
          {"served", trial.isServed(size)},
          {"fps", {{"min", rounded(load.fpsMin, 2)}, {"p50", rounded(load.fpsP50, 2)}}},
          {"latency_ms",
           {{"p50", rounded(load.latencyP50Milliseconds, 1)}, {"p99", rounded(load.latencyP99Milliseconds, 1)}}},
          {"lines_min", load.linesMin},
          {"errors", load.errors.size()},
          {"cpu_cores", rounded(trial.cpuCores, 3)},
          {"cpu_ms_per_frame", rounded(trial.cpuMillisecondsPerFrame(), 2)},
          {"memory_bytes", trial.bytes}};
}

void printJson(const CapacityPlan& plan, const CapacityResult& result) {
  ordered_json document = {{"capacity", {{"shared", result.shared}, {"private", result.unshared}}},
                           {"processor", measure::processorName()},
                           {"cores", std::max(1U, std::thread::hardware_concurrency())},
                           {"codec", codecName(plan.codec)},
                           {"size", nameOf(plan.size)},
                           {"seconds", plan.seconds},
                           {"law", nullptr},
                           {"trials", ordered_json::array()}};
  if (const auto law = capacityLaw(result.trials, result.shared)) {
    document["law"] = {{"alpha", rounded(law->alpha, 3)},
                       {"private_min", rounded(law->privateMin, 2)},
                       {"private_max", rounded(law->privateMax, 2)},
                       {"agrees", law->agrees(result.unshared)}};
  }
  for (const CapacityTrial& trial : result.trials) document["trials"].push_back(jsonOf(trial, plan.size));
  std::printf("%s\n", document.dump().c_str());
}

void printTable(const CapacityPlan& plan, const CapacityResult& result) {
  std::printf("%s, %u cores; %s, %s\n\n", measure::processorName().c_str(), std::thread::hardware_concurrency(),
              nameOf(plan.size).c_str(), codecName(plan.codec).c_str());
  std::printf("%8s %8s %7s %8s %8s %8s %6s %7s %9s %7s\n", "mode", "visitors", "served", "fps p50", "p50 ms", "p99 ms",
              "lines", "cores", "ms/frame", "MB");
  for (const CapacityTrial& trial : result.trials) {
    std::printf("%8s %8d %7s %8.1f %8.1f %8.1f %6d %7.2f %9.1f %7.0f\n", modeOf(trial.privateWorlds), trial.visitors,
                trial.isServed(plan.size) ? "yes" : "no", trial.load.fpsP50, trial.load.latencyP50Milliseconds,
                trial.load.latencyP99Milliseconds, trial.load.linesMin, trial.cpuCores, trial.cpuMillisecondsPerFrame(),
                static_cast<double>(trial.bytes) * 1e-6);
  }
  std::printf("\ncapacity: %d visitors who share one world, %d with a world each\n", result.shared, result.unshared);
  if (const auto law = capacityLaw(result.trials, result.shared)) {
    std::printf("the law M = N (1 - alpha) + alpha with alpha = %.2f: %.1f to %.1f with a world each (%s)\n",
                law->alpha, law->privateMin, law->privateMax,
                law->agrees(result.unshared) ? "agrees" : "does not agree");
  }
}

}  // namespace

int runBenchCapacity(const CapacityPlan& plan, bool json) {
  const StopOnSignal stop;
  const std::optional<CapacityResult> result = measureCapacity(plan, stop.token());
  if (!result) return 0;
  json ? printJson(plan, *result) : printTable(plan, *result);
  return 0;
}

}  // namespace grove::cli
