#include "cli/bench/amortize/bench_amortize.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <set>
#include <stdexcept>
#include <utility>

#include "base/error.h"
#include "cli/bench/amortize/bench_amortize_report.h"
#include "cli/bench/amortize/row_processes.h"
#include "cli/bench/amortize/task_process.h"
#include "cli/bench/codec_names.h"
#include "cli/prepare/prepare_world.h"
#include "cli/prepare/progress.h"
#include "objects/builtin_backends.h"
#include "pipeline/executor.h"

namespace grove::cli {
namespace {

/// Options that cannot be used; what() is one line.
class Refused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What the options ask for.
struct Plan {
  std::vector<Course> courses;
  std::vector<std::uint8_t> codecs;
  std::vector<int> users;  ///< rising
  AmortizeRun run;         ///< but for its visitors
  bool figure = false;
};

std::vector<int> usersOf(const BenchAmortizeOptions& options) {
  if (options.users.empty()) return {1, 2, 4, 8};
  std::vector<int> users = options.users;
  std::ranges::sort(users);
  if (const auto twice = std::ranges::adjacent_find(users); twice != users.end()) {
    throw Refused("--users has " + std::to_string(*twice) + " twice");
  }
  return users;
}

template <class Value>
void refuseTwice(const std::vector<Value>& values, const char* option, std::string (*nameOf)(Value)) {
  std::set<Value> distinct;
  for (const Value value : values) {
    if (!distinct.insert(value).second) throw Refused(std::string(option) + " has " + nameOf(value) + " twice");
  }
}

/// Opened before anything is measured.
std::ofstream plotFile(const BenchAmortizeOptions& options) {
  std::ofstream file;
  if (!options.plot) return file;
  file.open(*options.plot);
  if (!file) throw EnvironmentError("cannot be written", *options.plot, "--plot wants a file in an existing folder");
  return file;
}

/// Told by what a first row has held: every visitor's own, and a world for each in private mode.
void refuseWhatDoesNotFit(const AmortizeRow& first, int users) {
  const measure::MemoryShare share = measure::sum(first.memory);
  const double needed = users * (share.acrossUser + share.perUserBackend + share.perUserFrontend);
  const auto free = static_cast<double>(measure::availableMemory());
  if (needed <= free) return;
  const auto gigabytes = [](double bytes) { return std::to_string(std::lround(bytes * 1e-9)) + " GB"; };
  throw Refused(std::to_string(users) + " worlds need about " + gigabytes(needed) + " of memory, " + gigabytes(free) +
                " are free");
}

Plan planOf(const BenchAmortizeOptions& options) {
  Plan plan;
  plan.users = usersOf(options);
  refuseTwice(options.courses, "--walk", nameOf);
  refuseTwice(options.codecs, "--codec", codecName);
  plan.courses = options.courses;
  plan.codecs = options.codecs;
  plan.run.seconds = options.seconds;
  plan.run.frames = options.frames;
  plan.run.transport = options.transport;
  plan.run.size = options.size;
  plan.figure = options.figure || options.users.empty();
  return plan;
}

/// In the order of the table.
std::vector<AmortizeRun> runsOf(const Plan& plan) {
  std::vector<AmortizeRun> runs;
  for (const Course course : plan.courses) {
    for (const std::uint8_t codec : plan.codecs) {
      for (const int users : plan.users) {
        for (const bool privateWorlds : {false, true}) {
          AmortizeRun& run = runs.emplace_back(plan.run);
          run.users = users;
          run.privateWorlds = privateWorlds;
          run.course = course;
          run.codec = codec;
        }
      }
    }
  }
  return runs;
}

void measureRows(AmortizeResult& result, const Plan& plan, const world::Scene& scene, Interruption& interruption) {
  for (const AmortizeRun& run : runsOf(plan)) {
    const auto row = measureRow(scene, run, interruption);
    if (!row) return;
    const bool isFitted = run.course == plan.courses.front() && run.codec == plan.codecs.front();
    (isFitted ? result.rows : result.otherRows).push_back(*row);
    if (result.rows.size() == 1) refuseWhatDoesNotFit(*row, plan.users.back());
  }
}

/// Makes what the scene needs, in a process of its own: this one must stay without threads. Returns false after a
/// signal.
bool prepare(const world::Scene& scene, Interruption& interruption) {
  TaskProcess process([&scene](const TaskProcess::Parent&, const std::stop_token& stop) -> std::optional<std::string> {
    Progress progress;
    const bool isDone = prepareWorld(scene, objects::builtinBackends(), progress, stop);
    progress.finish();
    return isDone ? std::optional<std::string>("") : std::nullopt;
  });
  return process.awaitResult(interruption).has_value();
}

AmortizeResult measureAll(const Plan& plan, const world::Scene& scene, Interruption& interruption) {
  AmortizeResult result;
  result.transport = plan.run.transport;
  result.cores = pipeline::coreCount();
  if (prepare(scene, interruption)) measureRows(result, plan, scene, interruption);
  if (plan.figure && !interruption.hasCome()) result.figure = runFigure(plan.run.size, interruption);
  result.interrupted = interruption.hasCome();
  return result;
}

}  // namespace

int runBenchAmortize(const BenchAmortizeOptions& options) {
  try {
    Interruption interruption;
    const Plan plan = planOf(options);
    std::ofstream plot = plotFile(options);
    const AmortizeResult result = measureAll(plan, openScene(options.scene), interruption);
    if (plot.is_open()) plot << amortizePlot(result);
    const std::string text = options.json ? amortizeJson(result) : amortizeTables(result);
    std::fputs(text.c_str(), stdout);
    return 0;
  } catch (const Refused& e) {
    std::fprintf(stderr, "bench amortize: %s\n", e.what());
    return 2;
  }
}

}  // namespace grove::cli
