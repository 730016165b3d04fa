#include "measure/chrome_trace.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace grove::measure {
namespace {

using pipeline::TimelineEvent;

std::string jsonText(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// The format's unit; three decimals keep every nanosecond.
std::string thousandth(std::int64_t count) {
  char text[32];
  std::snprintf(text, sizeof text, "%lld.%03lld", static_cast<long long>(count / 1000),
                static_cast<long long>(count % 1000));
  return text;
}

/// Names of colours that chrome://tracing knows; Perfetto colours by the name of a slice.
const char* colourOf(pipeline::Work work) {
  switch (work) {
    case pipeline::Work::kAcrossUser:
      return "thread_state_running";
    case pipeline::Work::kPerUserBackend:
      return "thread_state_runnable";
    case pipeline::Work::kPerUserFrontend:
      return "thread_state_iowait";
  }
  return "";
}

/// By begin, and what is around before what is within.
std::vector<TimelineEvent> inOrder(std::span<const TimelineEvent> events) {
  std::vector<TimelineEvent> sorted(events.begin(), events.end());
  std::ranges::stable_sort(
      sorted, {}, [](const TimelineEvent& event) { return std::pair(event.beginNanoseconds, -event.wallNanoseconds); });
  return sorted;
}

/// Those of a frame that are not within others.
class RunsOfFrames {
 public:
  explicit RunsOfFrames(std::span<const TimelineEvent> sorted) : within_(sorted.size()) {
    std::map<std::uint32_t, std::int64_t> busyUntil;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      const TimelineEvent& event = sorted[i];
      std::int64_t& until = busyUntil[event.thread];
      within_[i] = event.beginNanoseconds < until;
      until = std::max(until, event.beginNanoseconds + event.wallNanoseconds);
      if (isStep(i, event)) ++steps_[keyOf(event)].second;
    }
  }

  /// The phase of the flow event that this run is: its frame's start, a step, its finish; 0 if there is nothing to tie.
  /// To be asked for each event once, in order.
  char phaseOf(std::size_t index, const TimelineEvent& event) {
    if (!isStep(index, event)) return 0;
    auto& [done, all] = steps_.at(keyOf(event));
    ++done;
    if (all == 1) return 0;
    if (done == 1) return 's';
    return done < all ? 't' : 'f';
  }

  static std::uint64_t keyOf(const TimelineEvent& event) {
    return std::uint64_t{event.tag.session} << 32U | event.tag.frame;
  }

 private:
  [[nodiscard]] bool isStep(std::size_t index, const TimelineEvent& event) const {
    return event.tag.session != 0 && !within_[index];
  }

  std::vector<bool> within_;
  std::map<std::uint64_t, std::pair<std::size_t, std::size_t>> steps_;  ///< done and all
};

class Writer {
 public:
  void write(const TraceSection& section, std::size_t index);
  std::string finish() { return std::move(text_) + "\n]}\n"; }

 private:
  void open(char phase) {
    text_ += first_ ? "\n" : ",\n";
    first_ = false;
    text_.append(R"({"ph":")").append(1, phase).append(R"(","pid":)").append(std::to_string(process_));
  }
  void at(const TimelineEvent& event) {
    text_.append(R"(,"tid":)").append(std::to_string(event.thread));
    text_.append(R"(,"ts":)").append(thousandth(event.beginNanoseconds - origin_));
  }
  void describeProcess(const std::string& name);
  void describeThreads(std::span<const TimelineEvent> events);
  void slice(const TimelineEvent& event);
  void flow(char phase, const TimelineEvent& event);

  std::string text_ = R"({"displayTimeUnit":"ms","traceEvents":[)";
  bool first_ = true;
  std::size_t process_ = 0;
  std::int64_t origin_ = 0;
};

void Writer::write(const TraceSection& section, std::size_t index) {
  process_ = index + 1;
  const std::vector<TimelineEvent> events = inOrder(section.events);
  origin_ = events.empty() ? 0 : events.front().beginNanoseconds;
  describeProcess(section.name);
  describeThreads(events);
  RunsOfFrames frames(events);
  for (std::size_t i = 0; i < events.size(); ++i) {
    slice(events[i]);
    if (const char phase = frames.phaseOf(i, events[i]); phase != 0) flow(phase, events[i]);
  }
}

void Writer::describeProcess(const std::string& name) {
  open('M');
  text_.append(R"(,"name":"process_name","args":{"name":)").append(jsonText(name)).append("}}");
  open('M');
  text_.append(R"(,"name":"process_sort_index","args":{"sort_index":)").append(std::to_string(process_)).append("}}");
}

void Writer::describeThreads(std::span<const TimelineEvent> events) {
  std::map<std::uint32_t, std::string_view> only;  // the stage, for a thread that runs one only
  for (const TimelineEvent& event : events) {
    const auto [found, isNew] = only.emplace(event.thread, event.stage);
    if (!isNew && found->second != event.stage) found->second = {};
  }
  for (const auto& [thread, stage] : only) {
    std::string name = "thread " + std::to_string(thread);
    if (!stage.empty()) name.append(" (").append(stage).append(")");
    open('M');
    text_.append(R"(,"tid":)").append(std::to_string(thread));
    text_.append(R"(,"name":"thread_name","args":{"name":)").append(jsonText(name)).append("}}");
  }
}

void Writer::slice(const TimelineEvent& event) {
  const std::string_view work = toString(event.work);
  std::string name = event.stage;
  if (!event.subject.empty()) name.append(": ").append(event.subject);
  open('X');
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

void Writer::flow(char phase, const TimelineEvent& event) {
  // Flows of one name are distinguished by number in the whole file. As text, since readers hold numbers in 53 bits.
  const std::uint64_t number = std::uint64_t{process_ - 1} << 56U | RunsOfFrames::keyOf(event);
  char id[32];
  std::snprintf(id, sizeof id, "0x%llx", static_cast<unsigned long long>(number));
  open(phase);
  at(event);
  text_.append(R"(,"name":"frame","cat":"frame","id":")").append(id).append("\"");
  // Without it, the arrow ends at the slice after the one that is around its end.
  if (phase == 'f') text_ += R"(,"bp":"e")";
  text_ += "}";
}

}  // namespace

std::string chromeTrace(std::span<const TraceSection> sections) {
  Writer writer;
  for (std::size_t i = 0; i < sections.size(); ++i) writer.write(sections[i], i);
  return writer.finish();
}

}  // namespace grove::measure
