#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "cli/processes.h"
#include "cli/program.h"
#include "cli/small_scene.h"
#include "measure/trace_faults.h"

namespace grove::cli {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(NodeCommand, PrintsItsAddressAndStopsOnSignal) {
  const SmallScene scene;
  const Outcome outcome =
      shell("out=$(mktemp); " GROVE_BINARY " node --objects mesh --listen 127.0.0.1:0 --scene " + scene.path() +
            " >$out 2>/dev/null & node=$!\n"
            "for try in {1..300}; do grep -qs listening $out && break; sleep 0.1; done\n"
            "kill -TERM $node; wait $node; echo ended with $?; sed 's/:[0-9]*$/:PORT/' $out; rm $out");
  EXPECT_EQ(outcome.output, "ended with 0\nlistening on 127.0.0.1:PORT\n");
}

TEST(NodeCommand, NamesUnknownObjects) {
  const SmallScene scene;
  const Outcome outcome = grove("node --objects mesh,dragon --listen 127.0.0.1:0 --scene " + scene.path());
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_THAT(outcome.output, HasSubstr("--objects: the scene has no object and no type 'dragon'"));
}

/// Would catch a server that makes models, GL or light though nodes serve all that it shows.
TEST(NodeCommand, ServerSkipsObjectsOfNodes) {
  const SmallScene scene;
  const Outcome outcome = shell(processesOf(scene) +
                                "starts all node --objects mesh,fluid --listen 127.0.0.1:0\n"
                                "serves a --nodes 127.0.0.1:$(port_of listening all)\n"
                                "kill -TERM $pid_a; wait $pid_a; echo ended with $?\n"
                                "grep -oE 'preparing|GL:|all in other processes' a.out");
  EXPECT_EQ(outcome.output, "ended with 0\nall in other processes\n");
}

/// Would catch an operator's page that shows a node's link, and nothing of what the node does.
TEST(NodeCommand, ReportAndTraceIncludeNodes) {
  const SmallScene scene;
  const Outcome outcome =
      shell(processesOf(scene) +
            "starts stones node --objects mesh --listen 127.0.0.1:0\n"
            "serves a --nodes 127.0.0.1:$(port_of listening stones); visit a 1 8 >errors & visit=$!\n"
            "until_says nodes_of a '\"Renderer\":{\"work\":\"per-user-backend\"' >&2\n"
            "nodes_of a | grep -o '\"memory\":{\"resident_mb\":[1-9]' >memory\n"
            "page_of a trace | sed '1,/^\\r$/d' >trace; wait $visit; cat errors memory trace");
  EXPECT_THAT(outcome.output, StartsWith("\"errors\":0\n\"memory\":{\"resident_mb\":"));
  const std::size_t begin = outcome.output.find("{\"displayTimeUnit\"");
  ASSERT_NE(begin, std::string::npos) << outcome.output;
  const auto trace = nlohmann::json::parse(outcome.output.substr(begin));
  EXPECT_EQ(measure::traceFault(trace), "");
  std::map<std::string, std::set<int>> framesProcesses;
  std::string names;
  for (const auto& event : trace.at("traceEvents")) {
    if (event.contains("id")) framesProcesses[event.at("id")].insert(event.at("pid").get<int>());
    if (event.at("name") == "process_name") names.append(event.at("args").at("name")).append("\n");
  }
  EXPECT_THAT(names, testing::MatchesRegex("stones\nthe node at 127.0.0.1:[0-9]+\n"));
  const auto isOfBoth = [](const auto& frame) { return frame.second.size() == 2; };
  EXPECT_TRUE(std::ranges::any_of(framesProcesses, isOfBoth)) << "a frame leads to the node";
}

TEST(NodeCommand, NamesAnUnreachableNode) {
  const SmallScene scene;
  const Outcome outcome = grove("serve --nodes 127.0.0.1:1 --listen 127.0.0.1:0 --scene " + scene.path());
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_THAT(outcome.output, HasSubstr("127.0.0.1:1: no node answers"));
}

TEST(NodeCommand, MeshesNeedTheirOwnModels) {
  const SmallScene scene;
  const Outcome outcome =
      grove("node --objects fluid,mesh --obstacles 127.0.0.1:1 --listen 127.0.0.1:0 --scene " + scene.path());
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_THAT(outcome.output, HasSubstr("--obstacles: objects of the type 'mesh' need the models of all others"));
  EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1);
}

TEST(NodeCommand, RefusesBadObstacleAddresses) {
  const SmallScene scene;
  const std::string node = "node --objects fluid --listen 127.0.0.1:0 --scene " + scene.path();
  const Outcome nonsense = grove(node + " --obstacles nonsense");
  EXPECT_EQ(nonsense.exit, 2);
  EXPECT_THAT(nonsense.output, HasSubstr("--obstacles wants HOST:PORT, not 'nonsense'"));
  EXPECT_EQ(grove(node + " --link-tls-ca ca.pem").exit, 2) << "there is no link";
  const Outcome nobody = grove(node + " --obstacles 127.0.0.1:1");
  EXPECT_EQ(nobody.exit, 1);
  EXPECT_THAT(nobody.output, HasSubstr("127.0.0.1:1: no node provides obstacles: Connection refused"));
  EXPECT_EQ(std::ranges::count(nobody.output, '\n'), 1);
}

}  // namespace
}  // namespace grove::cli
