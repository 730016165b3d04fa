#include "node/messages/wire/report_wire.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "node/messages/node.pb.h"

namespace grove::node {
namespace {

constexpr double kMaxNanoseconds = kMaxSeconds * 1.0e9;

bool isSpan(std::int64_t nanoseconds) {
  return nanoseconds >= 0 && static_cast<double>(nanoseconds) <= kMaxNanoseconds;
}

std::uint32_t codeOf(pipeline::Work work) { return static_cast<std::uint32_t>(work); }

pipeline::Work decodeWork(std::uint32_t from, Checks& checks) {
  const bool isKnown = from <= codeOf(pipeline::Work::kOnDemand);
  checks.require(isKnown, "its work is of an unknown kind");
  return isKnown ? static_cast<pipeline::Work>(from) : pipeline::Work::kAcrossUser;
}

void decodeStage(const v1::StageTotal& from, NodeReport& to, Checks& checks) {
  checks.require(isSpan(from.wall_ns()) && isSpan(from.cpu_ns()), "a stage's time is out of range");
  to.stages.try_emplace(decodeName(from.name(), checks), pipeline::StageTotal{.work = decodeWork(from.work(), checks),
                                                                              .runs = from.runs(),
                                                                              .failures = from.failures(),
                                                                              .wallNanoseconds = from.wall_ns(),
                                                                              .cpuNanoseconds = from.cpu_ns()});
}

void decodeHolder(const v1::MemoryTotal& from, NodeReport& to, Checks& checks) {
  to.memory.try_emplace({decodeName(from.holder(), checks), decodeName(from.subject(), checks)},
                        pipeline::MemoryTotal{.work = decodeWork(from.work(), checks), .bytes = from.bytes()});
}

/// Whether all columns have a value for each run.
bool isComplete(const v1::NodeTrace& from) {
  const int runs = from.stage_size();
  return from.subject_size() == runs && from.work_size() == runs && from.process_size() == runs &&
         from.session_size() == runs && from.frame_size() == runs && from.thread_size() == runs &&
         from.part_size() == runs && from.begin_after_last_ns_size() == runs && from.wall_ns_size() == runs &&
         from.cpu_ns_size() == runs;
}

TracedRun decodeRun(const v1::NodeTrace& from, int i, Checks& checks) {
  const int names = from.names_size();
  const auto isName = [&](std::uint32_t index) { return std::cmp_less(index, names); };
  checks.require(isName(from.stage(i)) && isName(from.subject(i)), "a run has no name");
  checks.require(isSpan(from.wall_ns(i)) && isSpan(from.cpu_ns(i)), "a run's time is out of range");
  return {.stage = from.stage(i),
          .subject = from.subject(i),
          .work = decodeWork(from.work(i), checks),
          .tag = {from.session(i), from.frame(i), from.process(i)},
          .thread = from.thread(i),
          .part = from.part(i),
          .wallNanoseconds = from.wall_ns(i),
          .cpuNanoseconds = from.cpu_ns(i)};
}

/// Adds the difference `after` to the last run's begin. Both are within the range of a clock, so the sum does not
/// overflow.
std::int64_t decodeBegin(std::int64_t last, std::int64_t after, Checks& checks) {
  const auto isOnClock = [](std::int64_t time) { return std::abs(static_cast<double>(time)) <= kMaxNanoseconds; };
  const std::int64_t begin = isOnClock(after) ? last + after : 0;
  checks.require(isOnClock(after) && isOnClock(begin), "a run begins out of range");
  return begin;
}

}  // namespace

void put(const NodeReport& from, v1::ToFrontend& envelope) {
  v1::NodeReport& to = *envelope.mutable_report();
  to.set_sent(from.sent);
  to.set_resident_bytes(from.residentBytes);
  for (const auto& [name, total] : from.stages) {
    v1::StageTotal& stage = *to.add_stages();
    stage.set_name(name);
    stage.set_work(codeOf(total.work));
    stage.set_runs(total.runs);
    stage.set_failures(total.failures);
    stage.set_wall_ns(total.wallNanoseconds);
    stage.set_cpu_ns(total.cpuNanoseconds);
  }
  for (const auto& [key, total] : from.memory) {
    v1::MemoryTotal& holder = *to.add_memory();
    holder.set_holder(key.holder);
    holder.set_subject(key.subject);
    holder.set_work(codeOf(total.work));
    holder.set_bytes(total.bytes);
  }
}

void put(const std::shared_ptr<const NodeTrace>& from, v1::ToFrontend& envelope) {
  v1::NodeTrace& to = *envelope.mutable_trace();
  to.set_number(from->number);
  for (const std::string& name : from->names) to.add_names(name);
  std::int64_t last = 0;
  for (const TracedRun& run : from->runs) {
    to.add_stage(run.stage);
    to.add_subject(run.subject);
    to.add_work(codeOf(run.work));
    to.add_process(run.tag.process);
    to.add_session(run.tag.session);
    to.add_frame(run.tag.frame);
    to.add_thread(run.thread);
    to.add_part(run.part);
    to.add_begin_after_last_ns(run.beginNanoseconds - std::exchange(last, run.beginNanoseconds));
    to.add_wall_ns(run.wallNanoseconds);
    to.add_cpu_ns(run.cpuNanoseconds);
  }
}

NodeReport decode(const v1::NodeReport& from, Checks& checks) {
  NodeReport to{.sent = from.sent(), .residentBytes = from.resident_bytes(), .stages = {}, .memory = {}};
  checks.require(isTime(from.sent()), "its clock is out of range");
  checks.require(std::cmp_less_equal(from.stages_size(), kMaxReportedStages), "it has too many stages");
  checks.require(std::cmp_less_equal(from.memory_size(), kMaxReportedHolders), "it has too many holders of memory");
  if (!checks.good()) return to;
  for (const v1::StageTotal& stage : from.stages()) decodeStage(stage, to, checks);
  for (const v1::MemoryTotal& holder : from.memory()) decodeHolder(holder, to, checks);
  return to;
}

std::shared_ptr<const NodeTrace> decode(const v1::NodeTrace& from, Checks& checks) {
  auto to = std::make_shared<NodeTrace>();
  to->number = from.number();
  checks.require(std::cmp_less_equal(from.names_size(), kMaxTraceNames), "it has too many names");
  checks.require(std::cmp_less_equal(from.stage_size(), kMaxTracedRuns), "it has too many runs");
  checks.require(isComplete(from), "its runs are incomplete");
  if (!checks.good()) return to;
  to->names.reserve(static_cast<std::size_t>(from.names_size()));
  for (const std::string& name : from.names()) to->names.push_back(decodeName(name, checks));
  to->runs.reserve(static_cast<std::size_t>(from.stage_size()));
  std::int64_t begin = 0;
  for (int i = 0; i < from.stage_size() && checks.good(); ++i) {
    TracedRun& run = to->runs.emplace_back(decodeRun(from, i, checks));
    run.beginNanoseconds = begin = decodeBegin(begin, from.begin_after_last_ns(i), checks);
  }
  return to;
}

}  // namespace grove::node
