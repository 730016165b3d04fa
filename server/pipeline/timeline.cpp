#include "pipeline/timeline.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <utility>

#include "pipeline/clocks.h"

namespace grove::pipeline {
namespace {

/// Events copied under one lock, which every stage run takes: some microseconds.
constexpr std::size_t kEventsAtOnce = 256;

std::uint32_t threadNumber() noexcept {
  static std::atomic<std::uint32_t> next{1};
  thread_local const std::uint32_t mine = next.fetch_add(1);
  return mine;
}

/// The run that contains a new one on this thread.
TimedRun*& innermostRun() noexcept {
  thread_local TimedRun* innermost = nullptr;
  return innermost;
}

void add(StageTotal& total, const StageTotal& more) {
  total.work = more.work;
  total.runs += more.runs;
  total.failures += more.failures;
  total.wallNanoseconds += more.wallNanoseconds;
  total.cpuNanoseconds += more.cpuNanoseconds;
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
    case Work::kOnDemand:
      return "on-demand";
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
    ring_[recorded_ % capacity_] = event;
  }
  ++recorded_;
  StageTotal& total = totals_[{event.stage, event.subject}];
  add(total, {.work = event.work,
              .runs = event.part ? 0U : 1U,
              .wallNanoseconds = event.part ? 0 : event.wallNanoseconds,
              .cpuNanoseconds = event.cpuNanoseconds});
}

void Timeline::recordFailure(const char* stage, Work work) {
  const std::lock_guard lock(mutex_);
  add(totals_[{stage, {}}], {.work = work, .failures = 1});
}

void Timeline::count(const char* counter, std::int64_t amount) {
  const std::lock_guard lock(mutex_);
  counters_[counter] += amount;
}

void Timeline::countReuse(std::string_view subject, const Reuse& more) {
  const std::lock_guard lock(mutex_);
  reuse_[subject] += more;
}

std::vector<TimelineEvent> Timeline::events(std::size_t max) const {
  std::size_t at = 0;
  std::size_t end = 0;
  {
    const std::lock_guard lock(mutex_);
    end = recorded_;
    at = end - std::min(max, ring_.size());
  }
  std::vector<TimelineEvent> copied;
  copied.reserve(end - at);
  while (at < end) {
    const std::lock_guard lock(mutex_);
    at = std::max(at, recorded_ - ring_.size());
    const std::size_t pieceEnd = std::min(end, at + kEventsAtOnce);
    for (; at < pieceEnd; ++at) copied.push_back(ring_[at % capacity_]);
  }
  return copied;
}

std::map<std::string, StageTotal> Timeline::totals() const {
  std::map<std::string, StageTotal> stages;
  for (const auto& [key, total] : costs()) add(stages[key.stage], total);
  return stages;
}

std::map<CostKey, StageTotal> Timeline::costs() const {
  const std::lock_guard lock(mutex_);
  std::map<CostKey, StageTotal> costs;
  for (const auto& [key, total] : totals_)
    costs.emplace(CostKey{std::string(key.first), std::string(key.second)}, total);
  return costs;
}

std::map<std::string, std::int64_t> Timeline::counters() const {
  const std::lock_guard lock(mutex_);
  return {counters_.begin(), counters_.end()};
}

std::map<std::string, Reuse> Timeline::reuse() const {
  const std::lock_guard lock(mutex_);
  return {reuse_.begin(), reuse_.end()};
}

TimedRun::TimedRun(Timeline& timeline, const char* stage, Work work, TraceTag tag, std::string_view subject) noexcept
    : timeline_(timeline),
      outer_(std::exchange(innermostRun(), this)),
      event_{.stage = stage,
             .subject = subject,
             .work = work,
             .tag = tag,
             .thread = threadNumber(),
             .part = outer_ != nullptr && std::string_view(outer_->event_.stage) == stage,
             .beginNanoseconds = wallNanoseconds()},
      cpuBegin_(threadCpuNanoseconds()) {}

TimedRun::~TimedRun() {
  const std::int64_t cpu = threadCpuNanoseconds() - cpuBegin_;
  event_.cpuNanoseconds = cpu - cpuWithin_;
  event_.wallNanoseconds = wallNanoseconds() - event_.beginNanoseconds;
  innermostRun() = outer_;
  if (outer_ != nullptr) outer_->cpuWithin_ += cpu;
  timeline_.record(event_);
}

TimedParts::TimedParts(Timeline& timeline, const char* stage, Work work, TraceTag tag) noexcept
    : timeline_(timeline),
      common_{.stage = stage,
              .work = work,
              .tag = tag,
              .thread = threadNumber(),
              .part = true,
              .beginNanoseconds = wallNanoseconds()} {}

void TimedParts::turnTo(std::string_view subject) {
  if (!parts_.empty() && parts_[current_].subject == subject) return;
  endTurn();
  const auto known = std::ranges::find(parts_, subject, &TimelineEvent::subject);
  current_ = static_cast<std::size_t>(known - parts_.begin());
  if (known == parts_.end()) parts_.emplace_back(common_).subject = subject;
}

void TimedParts::endTurn() {
  const std::int64_t wall = wallNanoseconds();
  const std::int64_t cpu = threadCpuNanoseconds();
  if (!parts_.empty()) {
    parts_[current_].wallNanoseconds += wall - wallBegin_;
    parts_[current_].cpuNanoseconds += cpu - cpuBegin_;
  }
  wallBegin_ = wall;
  cpuBegin_ = cpu;
}

TimedParts::~TimedParts() {
  endTurn();
  std::int64_t begin = common_.beginNanoseconds;
  for (TimelineEvent& part : parts_) {
    part.beginNanoseconds = begin;
    begin += part.wallNanoseconds;
    if (TimedRun* const run = innermostRun()) run->cpuWithin_ += part.cpuNanoseconds;
    timeline_.record(part);
  }
}

}  // namespace grove::pipeline
