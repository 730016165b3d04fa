#include "cli/bench/amortize/row_processes.h"

#include <deque>
#include <string>
#include <vector>

#include "base/log.h"
#include "cli/bench/amortize/task_process.h"
#include "cli/bench/codec_names.h"

namespace grove::cli {
namespace {

std::string described(const AmortizeRun& run) {
  return std::to_string(run.users) + (run.users == 1 ? " visitor, " : " visitors, ") +
         (run.privateWorlds ? "private" : "shared") + ", " + nameOf(run.course) + ", " + codecName(run.codec);
}

/// What each process measures.
std::vector<AmortizeRun> divided(const AmortizeRun& run) {
  if (!run.privateWorlds) return {run};
  std::vector<AmortizeRun> visitors(static_cast<std::size_t>(run.users), run);
  for (int i = 0; i < run.users; ++i) {
    visitors[static_cast<std::size_t>(i)].users = 1;
    visitors[static_cast<std::size_t>(i)].firstVisitor = i;
  }
  return visitors;
}

TaskProcess::Task taskOf(const world::Scene& scene, const AmortizeRun& run) {
  return [&scene, run](const TaskProcess::Parent& parent, const std::stop_token& stop) -> std::optional<std::string> {
    const auto row = runAmortize(
        scene, run, [&parent] { return parent.arrive(); }, stop);
    return row ? std::optional(pack(*row)) : std::nullopt;
  };
}

}  // namespace

std::optional<AmortizeRow> measureRow(const world::Scene& scene, const AmortizeRun& run, Interruption& interruption) {
  log::info(described(run) + ": preparing");
  std::deque<TaskProcess> processes;
  for (const AmortizeRun& part : divided(run)) processes.emplace_back(taskOf(scene, part));
  for (TaskProcess& process : processes) {
    if (!process.awaitArrival(interruption)) return std::nullopt;
  }
  log::info(described(run) + ": measuring");
  for (const TaskProcess& process : processes) process.proceed();
  std::vector<AmortizeRow> rows;
  for (TaskProcess& process : processes) {
    const std::optional<std::string> row = process.awaitResult(interruption);
    if (!row) return std::nullopt;
    rows.push_back(unpackRow(*row));
  }
  return run.privateWorlds ? together(rows) : rows.front();
}

}  // namespace grove::cli
