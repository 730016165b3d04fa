#include "stream/web_server/pages/live_reports.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <vector>

#include "base/log.h"
#include "measure/chrome_trace.h"
#include "pipeline/clocks.h"
#include "stream/web_server/pages/statistics_report.h"

namespace grove::stream {
namespace {

/// A few seconds of events.
constexpr std::size_t kMaxTraced = 16'384;
/// The trace omits nodes that take longer to respond.
constexpr std::chrono::milliseconds kTracePatience{1000};
constexpr double kFreshSeconds = 1.0;

StatisticsSources sourcesOf(const Host& host) {
  return {.timeline = host.timeline(),
          .memory = host.memory(),
          .meter = host.meter(),
          .visitors = host.visitors(),
          .visitorsOfWorld = host.visitorsOfWorld(),
          .joined = host.joined(),
          .nodes = host.nodeLinks(),
          .quality = host.quality(),
          .raisesQuality = host.options().raiseQuality,
          .governed = host.governor()->share()};
}

std::string statistics(const Host& host) { return statisticsJson(sourcesOf(host)); }
std::string sharing(const Host& host) { return sharingJson(sourcesOf(host)); }

/// A node's events from `begin` on, on this process's clock.
std::vector<pipeline::TimelineEvent> eventsSince(std::int64_t begin, const node::NodeRouter::NodeEvents& node) {
  std::vector<pipeline::TimelineEvent> events = node::eventsOf(*node.trace, node.aheadNanoseconds);
  std::erase_if(events, [=](const pipeline::TimelineEvent& event) { return event.beginNanoseconds < begin; });
  return events;
}

std::string trace(const Host& host) {
  const std::vector<node::NodeRouter::NodeEvents> nodes = host.nodeTraces(kTracePatience);
  std::vector<std::vector<pipeline::TimelineEvent>> events{host.timeline().events(kMaxTraced)};
  events.reserve(nodes.size() + 1);
  const std::int64_t begin = events.front().empty() ? 0 : events.front().front().beginNanoseconds;
  std::vector<measure::TraceSection> sections{{host.layout().name, events.front()}};
  for (const node::NodeRouter::NodeEvents& node : nodes) {
    events.push_back(eventsSince(begin, node));
    sections.push_back({node.name, events.back()});
  }
  return measure::chromeTrace(sections, measure::TraceClock::kOfAll);
}

struct Kind {
  std::string_view path;
  Audience audience;
  std::string (*make)(const Host&);
  bool large = false;  ///< no second copy is made while the first is being downloaded
};

constexpr std::array kKindsByPath = {
    Kind{"/statistics.json", Audience::kOperator, &statistics},
    Kind{"/trace.json", Audience::kOperator, &trace, true},
    Kind{"/sharing.json", Audience::kVisitors, &sharing},
};

LiveReports::Report make(const Kind& kind, const Host& host) {
  try {
    return std::make_shared<const std::string>(kind.make(host));
  } catch (const std::exception& e) {
    log::error(std::string(kind.path) + " cannot be made: " + e.what());
    return std::make_shared<const std::string>("null");
  }
}

}  // namespace

LiveReports::LiveReports(const Host& host, std::function<void()> ready)
    : host_(host), ready_(std::move(ready)), thread_([this] { run(); }) {
  static_assert(kKindsByPath.size() == kKinds);
}

LiveReports::~LiveReports() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

bool LiveReports::has(std::string_view path, Audience audience) noexcept {
  const auto kind = std::ranges::find(kKindsByPath, path, &Kind::path);
  return kind != kKindsByPath.end() && (kind->audience == Audience::kVisitors || audience == Audience::kOperator);
}

LiveReports::Report LiveReports::find(std::string_view path, double asked) {
  const auto kind = std::ranges::find(kKindsByPath, path, &Kind::path);
  assert(kind != kKindsByPath.end());
  const std::lock_guard lock(mutex_);
  Slot& slot = slots_[static_cast<std::size_t>(kind - kKindsByPath.begin())];
  const bool isKept = kind->large && slot.report.use_count() > 1;
  if (slot.report && (isKept || slot.begun > asked - kFreshSeconds)) return slot.report;
  slot.report.reset();
  slot.wanted = true;
  wake_.notify_one();
  return nullptr;
}

std::optional<std::size_t> LiveReports::firstWanted() const {
  const auto slot = std::ranges::find(slots_, true, &Slot::wanted);
  if (slot == slots_.end()) return std::nullopt;
  return static_cast<std::size_t>(slot - slots_.begin());
}

void LiveReports::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stopping_ || firstWanted(); });
    if (stopping_) return;
    const std::size_t kind = *firstWanted();
    lock.unlock();
    const double begun = pipeline::wallSeconds();
    Report report = make(kKindsByPath[kind], host_);
    lock.lock();
    slots_[kind] = {std::move(report), begun, false};
    lock.unlock();
    ready_();
    lock.lock();
  }
}

}  // namespace grove::stream
