#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string_view>
#include <variant>
#include <vector>

#include "node/one_node.h"
#include "pipeline/clocks.h"

namespace grove::node {
namespace {

/// What a backend node of boxes reports of its own work to a frontend process.
class NodeReports : public ::testing::TestWithParam<TransportKind> {
 protected:
  template <class Message>
  std::vector<Message> heard() {
    operatorsServer.settle();
    std::vector<Message> of;
    for (const ToFrontend& message : operatorsServer.messages()) {
      if (const auto* const one = std::get_if<Message>(&message)) of.push_back(*one);
    }
    return of;
  }
  /// The node draws a picture for session 1 of process 9.
  void draw() {
    const auto view = viewOf(makeId(9, 1));
    (void)operatorsServer.send(view);
    (void)operatorsServer.send(pictureOf(node, view));
    operatorsServer.settle();
  }

  OneNode node;
  RawPeer operatorsServer{node, GetParam()};
};

TEST_P(NodeReports, ReachWelcomedPeers) {
  node.backend.report(77);
  EXPECT_TRUE(heard<NodeReport>().empty()) << "before the welcome";
  ASSERT_EQ(operatorsServer.hello(9), "");
  draw();
  const pipeline::HeldMemory held(node.memory, "test", "box", pipeline::Work::kAcrossUser, 1000);
  const double before = pipeline::wallSeconds();
  node.backend.report(77);
  const auto reports = heard<NodeReport>();
  ASSERT_EQ(reports.size(), 1U);
  EXPECT_EQ(reports[0].residentBytes, 77U);
  EXPECT_GE(reports[0].sent, before);
  EXPECT_EQ(reports[0].stages.at("Renderer").runs, 1U);
  EXPECT_EQ(reports[0].memory.at({"test", "box"}).bytes, 1000);
}

TEST_P(NodeReports, TracesAreBoundedAndNewest) {
  ASSERT_EQ(operatorsServer.hello(9), "");
  draw();
  (void)operatorsServer.send(TraceRequest{.number = 5});
  (void)operatorsServer.send(TraceRequest{.number = 6});
  const auto traces = heard<std::shared_ptr<const NodeTrace>>();
  ASSERT_EQ(traces.size(), 1U) << "a peer that asks all the time costs no time";
  EXPECT_EQ(traces[0]->number, 5U);
  const std::vector<pipeline::TimelineEvent> events = eventsOf(*traces[0], 0);
  const auto drawn = std::ranges::find(events, std::string_view("Renderer"), &pipeline::TimelineEvent::stage);
  ASSERT_NE(drawn, events.end());
  EXPECT_EQ(drawn->tag.process, 9U);
  EXPECT_EQ(drawn->tag.session, 1U);
  EXPECT_EQ(drawn->tag.frame, 1U);
}

TEST_P(NodeReports, AreRefusedToOthers) {
  (void)operatorsServer.send(TraceRequest{.number = 5});
  EXPECT_TRUE(heard<std::shared_ptr<const NodeTrace>>().empty());
  EXPECT_EQ(node.refused(), 1);
}

INSTANTIATE_TEST_SUITE_P(OverBoth, NodeReports, testing::kBothInMemory, testing::transportName);

}  // namespace
}  // namespace grove::node
