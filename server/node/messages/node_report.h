#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "pipeline/memory_ledger.h"
#include "pipeline/timeline.h"

/// A backend node's reports of its own work, for the operator of a server that shows its objects.
namespace grove::node {

/// Stage totals and memory of a node's process. A node sends one a second.
struct NodeReport {
  double sent = 0.0;  ///< seconds of the node's clock
  std::uint64_t residentBytes = 0;
  std::map<std::string, pipeline::StageTotal> stages;  ///< since the node's start, without cadence
  std::map<pipeline::MemoryKey, pipeline::MemoryTotal> memory;
};

/// Requests a NodeTrace. A node answers at most two per second and frontend process, and ignores others.
struct TraceRequest {
  std::uint32_t number = 0;  ///< repeated in the answer
};

/// One event of a node's timeline, with indices of names.
struct TracedRun {
  std::uint32_t stage = 0;
  std::uint32_t subject = 0;
  pipeline::Work work = pipeline::Work::kAcrossUser;
  pipeline::TraceTag tag;
  std::uint32_t thread = 0;
  bool part = false;
  std::int64_t beginNanoseconds = 0;  ///< of the node's clock
  std::int64_t wallNanoseconds = 0;
  std::int64_t cpuNanoseconds = 0;
};

/// The newest events of a node's timeline.
struct NodeTrace {
  std::uint32_t number = 0;  ///< of the request
  std::vector<std::string> names;
  std::vector<TracedRun> runs;
};

inline constexpr std::size_t kMaxReportedStages = 256;
inline constexpr std::size_t kMaxReportedHolders = 1024;
inline constexpr std::size_t kMaxTraceNames = 1024;
/// The events of some seconds. They fit into kMaxHeaderBytes.
inline constexpr std::size_t kMaxTracedRuns = 16'384;

/// Returns the newest kMaxTracedRuns events.
[[nodiscard]] NodeTrace traceOf(const pipeline::Timeline& timeline, std::uint32_t number);

/// Returns the events on this process's clock; the node's clock is `ahead` nanoseconds ahead of it. The trace outlives
/// the events, which refer to its names.
[[nodiscard]] std::vector<pipeline::TimelineEvent> eventsOf(const NodeTrace& trace, std::int64_t ahead);

}  // namespace grove::node
