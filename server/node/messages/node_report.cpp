#include "node/messages/node_report.h"

#include <string_view>

namespace grove::node {
namespace {

/// Numbers names in the order of their first use.
class Names {
 public:
  explicit Names(std::vector<std::string>& names) : names_(names) {}
  std::uint32_t indexOf(std::string_view name) {
    const auto [found, isNew] = indices_.try_emplace(name, static_cast<std::uint32_t>(names_.size()));
    if (isNew) names_.emplace_back(name);
    return found->second;
  }

 private:
  std::vector<std::string>& names_;
  std::map<std::string_view, std::uint32_t> indices_;
};

}  // namespace

NodeTrace traceOf(const pipeline::Timeline& timeline, std::uint32_t number) {
  NodeTrace trace{.number = number, .names = {}, .runs = {}};
  const std::vector<pipeline::TimelineEvent> events = timeline.events(kMaxTracedRuns);
  trace.runs.reserve(events.size());
  Names names(trace.names);
  for (const pipeline::TimelineEvent& event : events) {
    trace.runs.push_back({.stage = names.indexOf(event.stage),
                          .subject = names.indexOf(event.subject),
                          .work = event.work,
                          .tag = event.tag,
                          .thread = event.thread,
                          .part = event.part,
                          .beginNanoseconds = event.beginNanoseconds,
                          .wallNanoseconds = event.wallNanoseconds,
                          .cpuNanoseconds = event.cpuNanoseconds});
  }
  return trace;
}

std::vector<pipeline::TimelineEvent> eventsOf(const NodeTrace& trace, std::int64_t ahead) {
  std::vector<pipeline::TimelineEvent> events;
  events.reserve(trace.runs.size());
  for (const TracedRun& run : trace.runs) {
    events.push_back({.stage = trace.names.at(run.stage).c_str(),
                      .subject = trace.names.at(run.subject),
                      .work = run.work,
                      .tag = run.tag,
                      .thread = run.thread,
                      .part = run.part,
                      .beginNanoseconds = run.beginNanoseconds - ahead,
                      .wallNanoseconds = run.wallNanoseconds,
                      .cpuNanoseconds = run.cpuNanoseconds});
  }
  return events;
}

}  // namespace grove::node
