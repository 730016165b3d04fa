#include "measure/chrome_trace.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

namespace grove::measure {
namespace {

using pipeline::TimelineEvent;

std::string jsonText(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Formats nanoseconds in the format's unit, microseconds; three decimals keep every nanosecond.
std::string thousandth(std::int64_t count) {
  char text[32];
  std::snprintf(text, sizeof text, "%lld.%03lld", static_cast<long long>(count / 1000),
                static_cast<long long>(count % 1000));
  return text;
}

/// Colour names of chrome://tracing; Perfetto colours by the name of a slice.
const char* colourOf(pipeline::Work work) {
  switch (work) {
    case pipeline::Work::kAcrossUser:
      return "thread_state_running";
    case pipeline::Work::kPerUserBackend:
      return "thread_state_runnable";
    case pipeline::Work::kPerUserFrontend:
      return "thread_state_iowait";
    case pipeline::Work::kOnDemand:
      return "thread_state_unknown";
  }
  return "";
}

/// An event and the process that shows it.
struct Placed {
  TimelineEvent event;
  std::size_t process = 0;
};

/// Sorts by begin, outer runs before the runs within them.
std::vector<Placed> inOrder(std::span<const TraceSection> sections, std::size_t firstProcess) {
  std::vector<Placed> sorted;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    for (const TimelineEvent& event : sections[i].events) sorted.push_back({event, firstProcess + i});
  }
  std::ranges::stable_sort(sorted, {}, [](const Placed& placed) {
    return std::pair(placed.event.beginNanoseconds, -placed.event.wallNanoseconds);
  });
  return sorted;
}

/// The runs of frames that are not within other runs.
class RunsOfFrames {
 public:
  using Frame = std::array<std::uint32_t, 3>;  ///< process, session, number

  explicit RunsOfFrames(std::span<const Placed> sorted) : within_(sorted.size()) {
    std::map<std::pair<std::size_t, std::uint32_t>, std::int64_t> busyUntil;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      const TimelineEvent& event = sorted[i].event;
      std::int64_t& until = busyUntil[{sorted[i].process, event.thread}];
      within_[i] = event.beginNanoseconds < until;
      until = std::max(until, event.beginNanoseconds + event.wallNanoseconds);
      if (isStep(i, event)) ++steps_[frameOf(event)].second;
    }
  }

  /// Returns the phase of this run's flow event: its frame's start, step or finish; 0 if there is nothing to connect.
  /// Call once per event, in order.
  char phaseOf(std::size_t index, const TimelineEvent& event) {
    if (!isStep(index, event)) return 0;
    auto& [done, all] = steps_.at(frameOf(event));
    ++done;
    if (all == 1) return 0;
    if (done == 1) return 's';
    return done < all ? 't' : 'f';
  }

  static Frame frameOf(const TimelineEvent& event) { return {event.tag.process, event.tag.session, event.tag.frame}; }

 private:
  [[nodiscard]] bool isStep(std::size_t index, const TimelineEvent& event) const {
    return event.tag.session != 0 && !within_[index];
  }

  std::vector<bool> within_;
  std::map<Frame, std::pair<std::size_t, std::size_t>> steps_;  ///< done and all
};

class Writer {
 public:
  /// Writes sections with one clock; the first is process `firstProcess`.
  void write(std::span<const TraceSection> sections, std::size_t firstProcess);
  std::string finish() { return std::move(text_) + "\n]}\n"; }

 private:
  void open(char phase, std::size_t process) {
    text_ += first_ ? "\n" : ",\n";
    first_ = false;
    text_.append(R"({"ph":")").append(1, phase).append(R"(","pid":)").append(std::to_string(process));
  }
  void at(const TimelineEvent& event) {
    text_.append(R"(,"tid":)").append(std::to_string(event.thread));
    text_.append(R"(,"ts":)").append(thousandth(event.beginNanoseconds - origin_));
  }
  void describeProcess(const std::string& name, std::size_t process);
  void describeThreads(std::span<const TimelineEvent> events, std::size_t process);
  void slice(const Placed& placed);
  void flow(char phase, const Placed& placed);

  std::string text_ = R"({"displayTimeUnit":"ms","traceEvents":[)";
  bool first_ = true;
  std::size_t group_ = 0;  ///< the process of the group's first section: frames belong to one group
  std::int64_t origin_ = 0;
};

void Writer::write(std::span<const TraceSection> sections, std::size_t firstProcess) {
  group_ = firstProcess;
  const std::vector<Placed> events = inOrder(sections, firstProcess);
  origin_ = events.empty() ? 0 : events.front().event.beginNanoseconds;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    describeProcess(sections[i].name, firstProcess + i);
    describeThreads(sections[i].events, firstProcess + i);
  }
  RunsOfFrames frames(events);
  for (std::size_t i = 0; i < events.size(); ++i) {
    slice(events[i]);
    if (const char phase = frames.phaseOf(i, events[i].event); phase != 0) flow(phase, events[i]);
  }
}

void Writer::describeProcess(const std::string& name, std::size_t process) {
  open('M', process);
  text_.append(R"(,"name":"process_name","args":{"name":)").append(jsonText(name)).append("}}");
  open('M', process);
  text_.append(R"(,"name":"process_sort_index","args":{"sort_index":)").append(std::to_string(process)).append("}}");
}

void Writer::describeThreads(std::span<const TimelineEvent> events, std::size_t process) {
  std::map<std::uint32_t, std::string_view> only;  // by thread: its only stage; empty if it runs several
  for (const TimelineEvent& event : events) {
    const auto [found, isNew] = only.emplace(event.thread, event.stage);
    if (!isNew && found->second != event.stage) found->second = {};
  }
  for (const auto& [thread, stage] : only) {
    std::string name = "thread " + std::to_string(thread);
    if (!stage.empty()) name.append(" (").append(stage).append(")");
    open('M', process);
    text_.append(R"(,"tid":)").append(std::to_string(thread));
    text_.append(R"(,"name":"thread_name","args":{"name":)").append(jsonText(name)).append("}}");
  }
}

void Writer::slice(const Placed& placed) {
  const TimelineEvent& event = placed.event;
  const std::string_view work = toString(event.work);
  std::string name = event.stage;
  if (!event.subject.empty()) name.append(": ").append(event.subject);
  open('X', placed.process);
  at(event);
  text_.append(R"(,"dur":)").append(thousandth(event.wallNanoseconds));
  text_.append(R"(,"name":)").append(jsonText(name));
  text_.append(R"(,"cat":")").append(work).append(R"(","cname":")").append(colourOf(event.work));
  text_.append(R"(","args":{"work":")").append(work);
  text_.append(R"(","cpu_ms":)").append(thousandth(event.cpuNanoseconds / 1000));
  if (event.tag.session != 0) {
    text_.append(R"(,"session":)").append(std::to_string(event.tag.session));
    text_.append(R"(,"frame":)").append(std::to_string(event.tag.frame));
  }
  text_ += "}}";
}

void Writer::flow(char phase, const Placed& placed) {
  // The id distinguishes flows of one name in the whole file.
  std::string id = std::to_string(group_);
  for (const std::uint32_t part : RunsOfFrames::frameOf(placed.event)) id.append(".").append(std::to_string(part));
  open(phase, placed.process);
  at(placed.event);
  text_.append(R"(,"name":"frame","cat":"frame","id":")").append(id).append("\"");
  // Without it, the arrow ends at the slice after the enclosing one.
  if (phase == 'f') text_ += R"(,"bp":"e")";
  text_ += "}";
}

}  // namespace

std::string chromeTrace(std::span<const TraceSection> sections, TraceClock clock) {
  Writer writer;
  const std::size_t together = clock == TraceClock::kOfAll ? sections.size() : 1;
  for (std::size_t i = 0; i < sections.size(); i += together) writer.write(sections.subspan(i, together), i + 1);
  return writer.finish();
}

}  // namespace grove::measure
