#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pipeline/reuse.h"

namespace grove::pipeline {

/// The beneficiary of work: the paper's c_i, c_b and c_f (section 3.1). The numbers travel in messages.
enum class Work : std::uint8_t {
  kAcrossUser,       ///< does not depend on any viewer
  kPerUserBackend,   ///< for one visitor
  kPerUserFrontend,  ///< for one visitor
  kOnDemand,         ///< shared data that a visitor's view caused; its uses say for whom it was, see Reuse
};

[[nodiscard]] std::string_view toString(Work work) noexcept;

/// The frame and session of an item; zeros if it has none.
struct TraceTag {
  std::uint32_t session = 0;
  std::uint32_t frame = 0;
  std::uint32_t process = 0;  ///< the session's frontend process; 0: unknown
};

/// One run of one stage, or a part of it that is counted separately, because it serves another type of object or is
/// work of another kind.
struct TimelineEvent {
  const char* stage = "";         ///< a string literal
  std::string_view subject = {};  ///< the type of object that it served; empty: none. Outlives the timeline
  Work work = Work::kAcrossUser;
  TraceTag tag;
  std::uint32_t thread = 0;           ///< small number, stable for a thread
  bool part = false;                  ///< within a run of the same stage
  std::int64_t beginNanoseconds = 0;  ///< monotonic clock
  std::int64_t wallNanoseconds = 0;
  std::int64_t cpuNanoseconds = 0;  ///< of the thread that ran it, without the runs within it
};

/// Sums since the start.
struct StageTotal {
  Work work = Work::kAcrossUser;
  std::uint64_t runs = 0;  ///< without parts of runs
  std::uint64_t failures = 0;
  std::int64_t wallNanoseconds = 0;
  std::int64_t cpuNanoseconds = 0;
};

/// The key of a total.
struct CostKey {
  std::string stage;
  std::string subject;
  friend auto operator<=>(const CostKey&, const CostKey&) = default;  // NOLINT(modernize-use-nullptr): sees 0 in <=>
};

/// Records every stage run, reported by the stage runner and by simulation clocks. Keeps the newest `capacity` events
/// and totals of all. Any thread.
class Timeline {
 public:
  explicit Timeline(std::size_t capacity = 1 << 16);

  void record(const TimelineEvent& event);
  void recordFailure(const char* stage, Work work);

  /// Adds to a named counter, such as the hits of a cache.
  void count(const char* counter, std::int64_t amount = 1);

  /// Adds to the uses of a subject's shared data that was made on demand. The subject outlives the timeline.
  void countReuse(std::string_view subject, const Reuse& more);

  /// Returns the newest events, at most `max`, oldest first. Stages continue meanwhile; events that they overwrite
  /// before they were copied are missing.
  [[nodiscard]] std::vector<TimelineEvent> events(std::size_t max = std::numeric_limits<std::size_t>::max()) const;
  /// By stage, for all subjects.
  [[nodiscard]] std::map<std::string, StageTotal> totals() const;
  /// By stage and subject. Each nanosecond of CPU is in exactly one of them.
  [[nodiscard]] std::map<CostKey, StageTotal> costs() const;
  [[nodiscard]] std::map<std::string, std::int64_t> counters() const;
  /// By subject.
  [[nodiscard]] std::map<std::string, Reuse> reuse() const;
  /// Memory of the events when all places are used.
  [[nodiscard]] std::size_t bytes() const noexcept { return capacity_ * sizeof(TimelineEvent); }

 private:
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::vector<TimelineEvent> ring_;
  std::size_t recorded_ = 0;  ///< since the start; the event n lies at n % capacity_
  std::map<std::pair<std::string_view, std::string_view>, StageTotal> totals_;
  std::map<std::string_view, std::int64_t> counters_;
  std::map<std::string_view, Reuse> reuse_;
};

/// Measures from construction to destruction and records it. One that is made during another's life on the same thread
/// is a part of it; its CPU does not count for the outer one.
class TimedRun {
 public:
  TimedRun(Timeline& timeline, const char* stage, Work work, TraceTag tag, std::string_view subject = {}) noexcept;
  ~TimedRun();
  TimedRun(const TimedRun&) = delete;
  TimedRun& operator=(const TimedRun&) = delete;

 private:
  friend class TimedParts;
  Timeline& timeline_;
  TimedRun* const outer_;
  TimelineEvent event_;
  std::int64_t cpuBegin_;
  std::int64_t cpuWithin_ = 0;
};

/// Counts the parts of a stage's run by subject, if they alternate, on the thread of the run or on another one. Records
/// one event per subject at the end, as if its parts had followed each other. Reading a thread's clock takes a good
/// part of a microsecond, so consecutive parts of one subject are measured as one. Contains no other runs. One thread.
class TimedParts {
 public:
  TimedParts(Timeline& timeline, const char* stage, Work work, TraceTag tag) noexcept;
  ~TimedParts();
  TimedParts(const TimedParts&) = delete;
  TimedParts& operator=(const TimedParts&) = delete;

  /// The following work is for this subject, which outlives the timeline.
  void turnTo(std::string_view subject);

 private:
  void endTurn();

  Timeline& timeline_;
  const TimelineEvent common_;
  std::vector<TimelineEvent> parts_;  ///< by subject, in the order of their first turns
  std::size_t current_ = 0;
  std::int64_t wallBegin_ = 0;  ///< of the turn
  std::int64_t cpuBegin_ = 0;
};

}  // namespace grove::pipeline
