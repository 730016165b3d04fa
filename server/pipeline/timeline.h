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

namespace grove::pipeline {

/// Who a piece of work is for: the paper's c_i, c_b and c_f (section 3.1).
enum class Work : std::uint8_t { kAcrossUser, kPerUserBackend, kPerUserFrontend };

[[nodiscard]] std::string_view toString(Work work) noexcept;

/// Which frame of which session an item belongs to; zeros where it belongs to none.
struct TraceTag {
  std::uint32_t session = 0;
  std::uint32_t frame = 0;
  std::uint32_t process = 0;  ///< the frontend process that the session belongs to; 0: not known
};

/// One run of one stage, or a part of it that is counted apart: by the type of object it serves, or because it is work
/// of another kind.
struct TimelineEvent {
  const char* stage = "";         ///< a string literal
  std::string_view subject = {};  ///< the type of object it was done for; empty: of none. Outlives the timeline
  Work work = Work::kAcrossUser;
  TraceTag tag;
  std::uint32_t thread = 0;           ///< small number, stable for a thread
  bool part = false;                  ///< within a run of the same stage
  double cadence = 0.0;               ///< runs a second by a clock; 0: it runs because somebody looks
  std::int64_t beginNanoseconds = 0;  ///< monotonic clock
  std::int64_t wallNanoseconds = 0;
  std::int64_t cpuNanoseconds = 0;  ///< of the thread that ran it, less what the runs within it have used
};

/// Sums since the start.
struct StageTotal {
  Work work = Work::kAcrossUser;
  std::uint64_t runs = 0;  ///< parts of runs are not counted
  std::uint64_t failures = 0;
  double cadence = 0.0;  ///< the newest run's
  std::int64_t wallNanoseconds = 0;
  std::int64_t cpuNanoseconds = 0;
};

/// What a total is of.
struct CostKey {
  std::string stage;
  std::string subject;
  friend auto operator<=>(const CostKey&, const CostKey&) = default;  // NOLINT(modernize-use-nullptr): sees 0 in <=>
};

/// Where every stage run is recorded, by the stage runner and by simulation clocks. Keeps the newest `capacity` events
/// and totals of all. Any thread.
class Timeline {
 public:
  explicit Timeline(std::size_t capacity = 1 << 16);

  void record(const TimelineEvent& event);
  void recordFailure(const char* stage, Work work);

  /// Adds to a named counter, for what is worth knowing and is no time: how often a cache had what was asked for.
  void count(const char* counter, std::int64_t amount = 1);

  /// The newest events that are kept, at most `max`, oldest first. Stages go on meanwhile; what they overwrite before
  /// it was copied is left out.
  [[nodiscard]] std::vector<TimelineEvent> events(std::size_t max = std::numeric_limits<std::size_t>::max()) const;
  /// By stage, whatever it was done for.
  [[nodiscard]] std::map<std::string, StageTotal> totals() const;
  /// By stage and subject. Every nanosecond of CPU is in one of them only.
  [[nodiscard]] std::map<CostKey, StageTotal> costs() const;
  [[nodiscard]] std::map<std::string, std::int64_t> counters() const;
  /// Memory that the events take once there are as many as are kept.
  [[nodiscard]] std::size_t bytes() const noexcept { return capacity_ * sizeof(TimelineEvent); }

 private:
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::vector<TimelineEvent> ring_;
  std::size_t recorded_ = 0;  ///< since the start; the event n lies at n % capacity_
  std::map<std::pair<std::string_view, std::string_view>, StageTotal> totals_;
  std::map<std::string_view, std::int64_t> counters_;
};

/// Measures from construction to destruction and records it. One that is made while another is alive on the same thread
/// is a part of that one, which then does not count its CPU.
class TimedRun {
 public:
  TimedRun(Timeline& timeline, const char* stage, Work work, TraceTag tag, std::string_view subject = {},
           double cadence = 0.0) noexcept;
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

/// Counts apart what parts of a stage's run are for that come in turns, on the thread of the run or on another one.
/// Records one event for each subject at the end, as if its turns had followed one another. Reading the clock of a
/// thread takes a good part of a microsecond, so turns of one subject that follow one another are one. Holds no other
/// runs. One thread.
class TimedParts {
 public:
  TimedParts(Timeline& timeline, const char* stage, Work work, TraceTag tag) noexcept;
  ~TimedParts();
  TimedParts(const TimedParts&) = delete;
  TimedParts& operator=(const TimedParts&) = delete;

  /// From here on it is for this subject, which outlives the timeline.
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
