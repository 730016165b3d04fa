#include "pipeline/timeline.h"

#include <atomic>
#include <cassert>

#include "pipeline/clocks.h"

namespace grove::pipeline {
namespace {

std::uint32_t threadNumber() noexcept {
  static std::atomic<std::uint32_t> next{1};
  thread_local const std::uint32_t mine = next.fetch_add(1);
  return mine;
}

}  // namespace

std::string_view toString(Work work) noexcept {
  switch (work) {
    case Work::kAcrossUser:
      return "across-user";
    case Work::kPerUserBackend:
      return "per-user-backend";
    case Work::kPerUserFrontend:
      return "per-user-frontend";
  }
  return "";
}

Timeline::Timeline(std::size_t capacity) : capacity_(capacity) {
  assert(capacity > 0);
  ring_.reserve(capacity);
}

void Timeline::record(const TimelineEvent& event) {
  const std::lock_guard lock(mutex_);
  if (ring_.size() < capacity_) {
    ring_.push_back(event);
  } else {
    ring_[next_] = event;
  }
  next_ = (next_ + 1) % capacity_;
  StageTotal& total = totals_[event.stage];
  total.work = event.work;
  ++total.runs;
  total.wallNanoseconds += event.wallNanoseconds;
  total.cpuNanoseconds += event.cpuNanoseconds;
}

void Timeline::recordFailure(const char* stage, Work work) {
  const std::lock_guard lock(mutex_);
  StageTotal& total = totals_[stage];
  total.work = work;
  ++total.failures;
}

void Timeline::count(const char* counter, std::int64_t amount) {
  const std::lock_guard lock(mutex_);
  counters_[counter] += amount;
}

std::vector<TimelineEvent> Timeline::events() const {
  const std::lock_guard lock(mutex_);
  if (ring_.size() < capacity_) return ring_;
  std::vector<TimelineEvent> ordered;
  ordered.reserve(capacity_);
  for (std::size_t i = 0; i < capacity_; ++i) ordered.push_back(ring_[(next_ + i) % capacity_]);
  return ordered;
}

std::map<std::string, StageTotal> Timeline::totals() const {
  const std::lock_guard lock(mutex_);
  return {totals_.begin(), totals_.end()};
}

std::map<std::string, std::int64_t> Timeline::counters() const {
  const std::lock_guard lock(mutex_);
  return {counters_.begin(), counters_.end()};
}

TimedRun::TimedRun(Timeline& timeline, const char* stage, Work work, TraceTag tag) noexcept
    : timeline_(timeline),
      event_{stage, work, tag, threadNumber(), wallNanoseconds(), 0, 0},
      cpuBegin_(threadCpuNanoseconds()) {}

TimedRun::~TimedRun() {
  event_.cpuNanoseconds = threadCpuNanoseconds() - cpuBegin_;
  event_.wallNanoseconds = wallNanoseconds() - event_.beginNanoseconds;
  timeline_.record(event_);
}

}  // namespace grove::pipeline
