#include "measure/chrome_trace.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "measure/trace_faults.h"

namespace grove::measure {
namespace {

using pipeline::TimedRun;
using pipeline::Timeline;
using pipeline::TimelineEvent;
using pipeline::Work;

/// A frame of two runs on two threads, the second with a part, and a tick.
std::vector<TimelineEvent> tinyTimeline() {
  constexpr std::int64_t kStart = 5'000'000'000'000;
  return {{.stage = "Scene Analyzer",
           .work = Work::kPerUserFrontend,
           .tag = {1, 7},
           .thread = 2,
           .beginNanoseconds = kStart,
           .wallNanoseconds = 1500,
           .cpuNanoseconds = 1234},
          {.stage = "Compositor",
           .subject = "fluid",
           .work = Work::kPerUserFrontend,
           .tag = {1, 7},
           .thread = 3,
           .part = true,
           .beginNanoseconds = kStart + 2100,
           .wallNanoseconds = 1'000'007,
           .cpuNanoseconds = 900'000},
          {.stage = "Compositor",
           .work = Work::kPerUserFrontend,
           .tag = {1, 7},
           .thread = 3,
           .beginNanoseconds = kStart + 2000,
           .wallNanoseconds = 2'000'000,
           .cpuNanoseconds = 50'000},
          {.stage = "Simulation Tick",
           .work = Work::kAcrossUser,
           .tag = {},
           .thread = 3,
           .beginNanoseconds = kStart + 3'000'000,
           .wallNanoseconds = 5,
           .cpuNanoseconds = 0}};
}

TEST(ChromeTrace, MatchesGoldenText) {
  const auto events = tinyTimeline();
  const TraceSection section{"one \"frame\"", events};
  const std::string expected = R"json({"displayTimeUnit":"ms","traceEvents":[
{"ph":"M","pid":1,"name":"process_name","args":{"name":"one \"frame\""}},
{"ph":"M","pid":1,"name":"process_sort_index","args":{"sort_index":1}},
{"ph":"M","pid":1,"tid":2,"name":"thread_name","args":{"name":"thread 2 (Scene Analyzer)"}},
{"ph":"M","pid":1,"tid":3,"name":"thread_name","args":{"name":"thread 3"}},
{"ph":"X","pid":1,"tid":2,"ts":0.000,"dur":1.500,"name":"Scene Analyzer","cat":"per-user-frontend","cname":"thread_state_iowait","args":{"work":"per-user-frontend","cpu_ms":0.001,"session":1,"frame":7}},
{"ph":"s","pid":1,"tid":2,"ts":0.000,"name":"frame","cat":"frame","id":"1.0.1.7"},
{"ph":"X","pid":1,"tid":3,"ts":2.000,"dur":2000.000,"name":"Compositor","cat":"per-user-frontend","cname":"thread_state_iowait","args":{"work":"per-user-frontend","cpu_ms":0.050,"session":1,"frame":7}},
{"ph":"f","pid":1,"tid":3,"ts":2.000,"name":"frame","cat":"frame","id":"1.0.1.7","bp":"e"},
{"ph":"X","pid":1,"tid":3,"ts":2.100,"dur":1000.007,"name":"Compositor: fluid","cat":"per-user-frontend","cname":"thread_state_iowait","args":{"work":"per-user-frontend","cpu_ms":0.900,"session":1,"frame":7}},
{"ph":"X","pid":1,"tid":3,"ts":3000.000,"dur":0.005,"name":"Simulation Tick","cat":"across-user","cname":"thread_state_running","args":{"work":"across-user","cpu_ms":0.000}}
]}
)json";
  EXPECT_EQ(chromeTrace({&section, 1}), expected);
}

TEST(ChromeTrace, EmptyTimelineIsValid) {
  EXPECT_TRUE(nlohmann::json::parse(chromeTrace({})).at("traceEvents").empty());
  const TraceSection nothing{"nothing", {}};
  EXPECT_EQ(nlohmann::json::parse(chromeTrace({&nothing, 1})).at("traceEvents").size(), 2u);
}

TEST(ChromeTrace, NestsRuns) {
  Timeline timeline;
  for (std::uint32_t frame = 1; frame <= 20; ++frame) {
    const TimedRun outer(timeline, "Renderer", Work::kPerUserBackend, {1, frame}, "lightfield");
    for (int i = 0; i < 3; ++i) {
      const TimedRun part(timeline, "Renderer", Work::kPerUserBackend, {1, frame}, "mesh");
      const TimedRun other(timeline, "Shared View", Work::kOnDemand, {1, frame});
    }
  }
  const auto events = timeline.events();
  const TraceSection section{"nested", events};
  EXPECT_EQ(traceFault(nlohmann::json::parse(chromeTrace({&section, 1}))), "");
}

TEST(ChromeTrace, SeparatesSections) {
  const auto events = tinyTimeline();
  const std::vector<TraceSection> sections{{"a", events}, {"b", events}};
  const auto document = nlohmann::json::parse(chromeTrace(sections));
  EXPECT_EQ(traceFault(document), "");
  std::set<std::string> flows;
  std::set<int> processes;
  for (const auto& event : document.at("traceEvents")) {
    if (event.contains("id")) flows.insert(event.at("id").get<std::string>());
    processes.insert(event.at("pid").get<int>());
  }
  EXPECT_EQ(flows.size(), 2u);
  EXPECT_EQ(processes, (std::set<int>{1, 2}));
}

/// Would catch a node's events that lie at another time than what the server does for the same frame, frames that end
/// at the border of a process, and frames of two servers that a node's arrows tie together.
TEST(ChromeTrace, ConnectsAFrameAcrossSections) {
  constexpr std::int64_t kMillisecond = 1'000'000;
  const auto run = [](std::int64_t begin, std::uint32_t process) {
    return TimelineEvent{.stage = "Renderer",
                         .tag = {1, 7, process},
                         .thread = 1,
                         .beginNanoseconds = begin * kMillisecond,
                         .wallNanoseconds = kMillisecond};
  };
  const std::vector<TimelineEvent> server{run(10, 5), run(16, 5)};
  const std::vector<TimelineEvent> node{run(12, 5), run(14, 6)};
  const std::vector<TraceSection> sections{{"server", server}, {"node", node}};
  const auto document = nlohmann::json::parse(chromeTrace(sections, TraceClock::kOfAll));
  EXPECT_EQ(traceFault(document), "");
  std::vector<std::string> arrows;
  for (const auto& event : document.at("traceEvents")) {
    if (!event.contains("id")) continue;
    arrows.push_back(event.at("ph").get<std::string>() + " " + event.at("pid").dump() + " " + event.at("ts").dump());
  }
  EXPECT_EQ(arrows, (std::vector<std::string>{"s 1 0.0", "t 2 2000.0", "f 1 6000.0"}));
}

TEST(ChromeTrace, TruncatedTimelineHasNoDanglingFlow) {
  auto events = tinyTimeline();
  events.erase(events.begin());
  const TraceSection section{"cut", events};
  const auto document = nlohmann::json::parse(chromeTrace({&section, 1}));
  EXPECT_EQ(traceFault(document), "");
  for (const auto& event : document.at("traceEvents")) EXPECT_FALSE(event.contains("id")) << event;
}

TEST(TraceFault, DetectsFaults) {
  auto events = tinyTimeline();
  events[3].beginNanoseconds = events[2].beginNanoseconds + 1'500'000;
  events[3].wallNanoseconds = 1'000'000;
  const TraceSection section{"broken", events};
  EXPECT_NE(traceFault(nlohmann::json::parse(chromeTrace({&section, 1}))), "");
}

}  // namespace
}  // namespace grove::measure
