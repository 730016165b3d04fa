#include "node/messages/wire/report_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "node/messages/examples.h"
#include "node/messages/wire/wire.h"

namespace grove::node {
namespace {

using TracePointer = std::shared_ptr<const NodeTrace>;
using testing::HasSubstr;

ToFrontend messageOf(NodeReport report) { return report; }
ToFrontend messageOf(NodeTrace trace) { return std::make_shared<const NodeTrace>(std::move(trace)); }

/// After it has travelled.
template <class Sent>
ToFrontend decoded(const Sent& sent) {
  return std::get<ToFrontend>(decodeToFrontend(encode(messageOf(sent))));
}

/// Why it is refused once `spoil` has changed it.
template <class Sent>
std::string reasonAgainst(Sent sent, const std::function<void(Sent&)>& spoil) {
  spoil(sent);
  const auto refused = decodeToFrontend(encode(messageOf(std::move(sent))));
  const auto* const error = std::get_if<WireError>(&refused);
  return error == nullptr ? "nothing wrong" : error->reason;
}

TEST(ReportWire, CarriesReports) {
  const NodeReport sent = examples::report();
  const NodeReport got = std::get<NodeReport>(decoded(sent));
  EXPECT_EQ(got.sent, sent.sent);
  EXPECT_EQ(got.residentBytes, sent.residentBytes);
  ASSERT_EQ(got.stages.size(), 3U);
  EXPECT_EQ(got.stages.at("Shared View").work, pipeline::Work::kOnDemand);
  const pipeline::StageTotal& renderer = got.stages.at("Renderer");
  EXPECT_EQ(renderer.work, pipeline::Work::kPerUserBackend);
  EXPECT_EQ(renderer.runs, 40U);
  EXPECT_EQ(renderer.failures, 2U);
  EXPECT_EQ(renderer.wallNanoseconds, 7'000'000);
  EXPECT_EQ(renderer.cpuNanoseconds, 6'500'000);
  ASSERT_EQ(got.memory.size(), 2U);
  EXPECT_EQ(got.memory.at({"view cache", "lightfield"}).bytes, 1'000'000);
  EXPECT_EQ(got.memory.at({"view cache", "lightfield"}).work, pipeline::Work::kOnDemand);
  EXPECT_EQ(got.memory.at({"targets", ""}).work, pipeline::Work::kPerUserBackend);
}

TEST(ReportWire, CarriesTraces) {
  const auto request = decodeToBackend(encode(ToBackend(TraceRequest{.number = 77})).header, examples::knownView());
  EXPECT_EQ(std::get<TraceRequest>(std::get<ToBackend>(request)).number, 77U);
  const NodeTrace sent = examples::trace();
  const NodeTrace got = *std::get<TracePointer>(decoded(sent));
  EXPECT_EQ(got.number, sent.number);
  const std::vector<pipeline::TimelineEvent> events = eventsOf(got, 1'000);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_STREQ(events[0].stage, "Renderer");
  EXPECT_EQ(events[0].subject, "fluid");
  EXPECT_EQ(events[0].work, pipeline::Work::kPerUserBackend);
  EXPECT_EQ(events[0].tag.process, 3U);
  EXPECT_EQ(events[0].tag.session, 1U);
  EXPECT_EQ(events[0].tag.frame, examples::kFrame);
  EXPECT_EQ(events[0].thread, 2U);
  EXPECT_TRUE(events[0].part);
  EXPECT_EQ(events[0].beginNanoseconds, 4'999'999'999'000) << "on the other clock";
  EXPECT_EQ(events[0].wallNanoseconds, 1'500'000);
  EXPECT_EQ(events[0].cpuNanoseconds, 1'400'000);
  EXPECT_STREQ(events[1].stage, "Simulation Tick");
  EXPECT_EQ(events[1].beginNanoseconds, 4'999'989'999'000);
}

/// Would catch a full timeline that the link refuses for its size.
TEST(ReportWire, LargestTraceFits) {
  pipeline::Timeline timeline;
  for (std::size_t i = 0; i < 2 * kMaxTracedRuns; ++i) {
    timeline.record({.stage = "Renderer",
                     .tag = {0xFFFFFFFFU, 0xFFFFFFFFU, 0xFFFFFFFFU},
                     .thread = 0xFFFFFFFFU,
                     .beginNanoseconds = static_cast<std::int64_t>(i % 2) << 50U,
                     .wallNanoseconds = std::int64_t{1} << 46U,
                     .cpuNanoseconds = std::int64_t{1} << 46U});
  }
  EXPECT_EQ(std::get<TracePointer>(decoded(traceOf(timeline, 1)))->runs.size(), kMaxTracedRuns);
}

TEST(ReportWire, RefusesBadReports) {
  const auto spoilt = [](const std::function<void(NodeReport&)>& spoil) {
    return reasonAgainst(examples::report(), spoil);
  };
  EXPECT_THAT(spoilt([](NodeReport& report) { report.sent = std::numeric_limits<double>::quiet_NaN(); }),
              HasSubstr("clock"));
  EXPECT_THAT(spoilt([](NodeReport& report) { report.sent = 1.0e300; }), HasSubstr("clock"));
  EXPECT_THAT(spoilt([](NodeReport& report) { report.stages["\xC3"] = {}; }), HasSubstr("UTF-8"));
  EXPECT_THAT(spoilt([](NodeReport& report) { report.memory[{"view cache", "\xC3"}] = {}; }), HasSubstr("UTF-8"));
  EXPECT_THAT(spoilt([](NodeReport& report) { report.stages["Renderer"].cpuNanoseconds = -1; }), HasSubstr("time"));
  EXPECT_THAT(spoilt([](NodeReport& report) { report.stages["Renderer"].work = pipeline::Work{7}; }),
              HasSubstr("work"));
  EXPECT_THAT(spoilt([](NodeReport& report) {
                for (std::size_t i = 0; i <= kMaxReportedStages; ++i) report.stages[std::to_string(i)] = {};
              }),
              HasSubstr("too many stages"));
  EXPECT_THAT(spoilt([](NodeReport& report) {
                for (std::size_t i = 0; i <= kMaxReportedHolders; ++i) report.memory[{std::to_string(i), ""}] = {};
              }),
              HasSubstr("too many holders"));
}

/// Would catch indices beyond the names, and times whose sum overflows.
TEST(ReportWire, RefusesBadTraces) {
  const auto spoilt = [](const std::function<void(NodeTrace&)>& spoil) {
    return reasonAgainst(examples::trace(), spoil);
  };
  constexpr std::int64_t kForever = std::numeric_limits<std::int64_t>::max();
  EXPECT_THAT(spoilt([](NodeTrace& trace) { trace.runs[1].stage = 4; }), HasSubstr("no name"));
  EXPECT_THAT(spoilt([](NodeTrace& trace) { trace.runs[1].subject = 0xFFFFFFFFU; }), HasSubstr("no name"));
  EXPECT_THAT(spoilt([](NodeTrace& trace) { trace.runs[0].wallNanoseconds = -1; }), HasSubstr("time"));
  EXPECT_THAT(spoilt([](NodeTrace& trace) { trace.runs[0].beginNanoseconds = kForever; }), HasSubstr("begins"));
  EXPECT_THAT(spoilt([](NodeTrace& trace) { trace.runs[1].work = pipeline::Work{4}; }), HasSubstr("work"));
  EXPECT_THAT(spoilt([](NodeTrace& trace) { trace.names[1] = "\xC3"; }), HasSubstr("UTF-8"));
  EXPECT_THAT(spoilt([](NodeTrace& trace) { trace.names.resize(kMaxTraceNames + 1); }), HasSubstr("too many names"));
  EXPECT_THAT(spoilt([](NodeTrace& trace) { trace.runs.resize(kMaxTracedRuns + 1); }), HasSubstr("too many runs"));
}

TEST(ReportWire, RefusesColumnsOfDifferentLengths) {
  std::string header = encode(ToFrontend(std::make_shared<const NodeTrace>(examples::trace()))).header;
  const std::string parts("\x52\x02\x01\x00", 4);
  const std::size_t column = header.find(parts);
  ASSERT_NE(column, std::string::npos);
  header[column] = '\x6A';  // a fourteenth field, which nobody knows, with the bytes of the tenth
  EXPECT_THAT(std::get<WireError>(decodeToFrontend({header, nullptr})).reason, HasSubstr("incomplete"));
}

}  // namespace
}  // namespace grove::node
