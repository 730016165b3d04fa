#include "measure/utilisation.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace grove::measure {
namespace {

using pipeline::TimelineEvent;

constexpr std::string_view kLastStage = "Encoder";

std::int64_t endOf(const TimelineEvent& event) { return event.beginNanoseconds + event.wallNanoseconds; }

bool endsWithin(const TimelineEvent& event, const Window& window) {
  return endOf(event) >= window.beginNanoseconds && endOf(event) <= window.endNanoseconds;
}

/// Gathers the runs of one row.
class Gathered {
 public:
  void add(const TimelineEvent& event, const Window& window) {
    const std::int64_t begin = std::max(event.beginNanoseconds, window.beginNanoseconds);
    const std::int64_t end = std::min(endOf(event), window.endNanoseconds);
    if (begin < end) active_.emplace_back(begin, end);
    if (!endsWithin(event, window)) return;
    cpu_ += event.cpuNanoseconds;
    (event.part ? partsWall_ : runsWall_) += event.wallNanoseconds;
    if (!event.part) ++runs_;
  }

  [[nodiscard]] std::uint64_t runs() const noexcept { return runs_; }

  /// `runs`: number of runs that the parts belong to, used if there are only parts.
  [[nodiscard]] Use use(const Window& window, std::uint64_t runs) {
    const bool onlyParts = runs_ == 0;
    Use use;
    use.runs = onlyParts ? runs : runs_;
    const double perRun = 1.0e-6 / static_cast<double>(std::max<std::uint64_t>(1, use.runs));
    use.wallMillisecondsPerRun = static_cast<double>(onlyParts ? partsWall_ : runsWall_) * perRun;
    use.cpuMillisecondsPerRun = static_cast<double>(cpu_) * perRun;
    use.utilisation = static_cast<double>(covered()) * 1.0e-9 / window.seconds();
    return use;
  }

 private:
  std::int64_t covered() {
    std::ranges::sort(active_);
    std::int64_t sum = 0;
    std::int64_t until = 0;
    for (const auto& [begin, end] : active_) {
      sum += std::max<std::int64_t>(0, end - std::max(begin, until));
      until = std::max(until, end);
    }
    return sum;
  }

  std::uint64_t runs_ = 0;
  std::int64_t runsWall_ = 0;
  std::int64_t partsWall_ = 0;
  std::int64_t cpu_ = 0;
  std::vector<std::pair<std::int64_t, std::int64_t>> active_;
};

struct GatheredStage {
  Gathered all;
  bool servesFrames = false;
  std::map<std::string_view, Gathered> types;
};

}  // namespace

std::map<std::string, StageUse> stageUse(std::span<const TimelineEvent> events, const Window& window) {
  std::map<std::string_view, GatheredStage> gathered;
  for (const TimelineEvent& event : events) {
    GatheredStage& stage = gathered[event.stage];
    if (endOf(event) < window.beginNanoseconds || event.beginNanoseconds > window.endNanoseconds) continue;
    stage.all.add(event, window);
    stage.servesFrames |= event.tag.session != 0;
    if (!event.subject.empty()) stage.types[event.subject].add(event, window);
  }
  std::map<std::string, StageUse> stages;
  for (auto& [name, stage] : gathered) {
    const std::uint64_t runs = stage.all.runs();
    StageUse& use = stages[std::string(name)];
    use.all = stage.all.use(window, runs);
    use.servesFrames = stage.servesFrames;
    for (auto& [type, of] : stage.types) use.types.emplace(type, of.use(window, runs));
  }
  return stages;
}

std::string bottleneck(const std::map<std::string, StageUse>& stages) {
  std::string busiest;
  double max = 0.0;
  for (const auto& [name, stage] : stages) {
    if (!stage.servesFrames || stage.all.utilisation <= max) continue;
    max = stage.all.utilisation;
    busiest = name;
  }
  return busiest;
}

std::vector<FrameSpan> deliveredFrames(std::span<const TimelineEvent> events, const Window& window) {
  struct Progress {
    std::int64_t begin = 0;
    std::int64_t end = 0;
    bool delivered = false;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Progress> frames;
  for (const TimelineEvent& event : events) {
    if (event.tag.session == 0) continue;
    const auto [found, isNew] = frames.try_emplace({event.tag.session, event.tag.frame});
    Progress& frame = found->second;
    frame.begin = isNew ? event.beginNanoseconds : std::min(frame.begin, event.beginNanoseconds);
    if (event.part || event.stage != kLastStage || !endsWithin(event, window)) continue;
    frame.end = endOf(event);
    frame.delivered = true;
  }
  std::vector<FrameSpan> spans;
  for (const auto& [tag, frame] : frames) {
    if (frame.delivered) spans.push_back({{tag.first, tag.second}, frame.begin, frame.end});
  }
  return spans;
}

double overlap(std::span<const FrameSpan> frames, const Window& window, int sessions) {
  double inProgress = 0.0;
  for (const FrameSpan& frame : frames) inProgress += frame.milliseconds();
  return inProgress * 1.0e-3 / window.seconds() / std::max(1, sessions);
}

}  // namespace grove::measure
