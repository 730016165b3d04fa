#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cli/program.h"
#include "cli/small_scene.h"

namespace grove::cli {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// The output of a script that has a server of the small scene at $port.
Outcome whileServed(const std::string& script) {
  const SmallScene scene;
  return shell("served=$(mktemp); " GROVE_BINARY " serve --listen 127.0.0.1:0 --scene " + scene.path() +
               " >$served 2>/dev/null & server=$!\n"
               "until grep -q listening $served; do sleep 0.1; kill -0 $server || break; done\n"
               "port=$(sed -n 's/^listening.*://p' $served); rm $served\n" +
               script + "\nstatus=$?; kill -INT $server; wait $server; exit $status");
}

TEST(LoadCommand, LoadPrintsItsDocument) {
  const Outcome outcome = whileServed(GROVE_BINARY
                                      " load ws://127.0.0.1:$port/ --sessions 2 --seconds 1 --width 320 --height 180"
                                      " --codec jpeg --look --shape 20mbit,20ms,jitter=2ms --json 2>/dev/null");
  ASSERT_EQ(outcome.exit, 0);
  const auto report = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(report.at("sessions"), 2);
  EXPECT_EQ(report.at("errors"), 0);
  EXPECT_EQ(report.at("codec"), "jpeg");
  EXPECT_EQ(report.at("shape"), "20mbit,20ms,jitter=2ms");
  EXPECT_GT(report.at("latency_ms").at("p50"), 20.0);
  EXPECT_GE(report.at("latency_ms").at("p95"), report.at("latency_ms").at("p50"));
  EXPECT_GE(report.at("latency_ms").at("p99"), report.at("latency_ms").at("p95"));
  EXPECT_GE(report.at("lines").at("min"), 90);
  EXPECT_LE(report.at("lines").at("p50"), 180);
  EXPECT_GT(report.at("longest_gap_ms"), 0.0);
  for (const char* key : {"fps", "mbit_per_s", "dropped", "seconds", "frames"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
}

TEST(LoadCommand, LoadFollowsAWalkAndPrintsATable) {
  const Outcome outcome =
      whileServed(GROVE_BINARY " load ws://127.0.0.1:$port/ --seconds 1 --width 320 --height 180 --walk " GROVE_WALKS
                               "/clearing.walk 2>&1");
  EXPECT_EQ(outcome.exit, 0) << outcome.output;
  for (const char* row : {"p95", "longest gap", "codec", "lines"}) EXPECT_THAT(outcome.output, HasSubstr(row));
}

TEST(LoadCommand, ShapeSaysWhereItListensAndEndsAtASignal) {
  for (const char* signal : {"INT", "TERM"}) {
    const Outcome outcome =
        whileServed("shaped=$(mktemp); " GROVE_BINARY
                    " shape 20mbit,20ms --listen 127.0.0.1:0 --to 127.0.0.1:$port >$shaped & shaper=$!\n"
                    "until grep -q listening $shaped; do sleep 0.1; kill -0 $shaper || break; done\n"
                    "cat $shaped; at=$(sed -n 's/^listening on //p' $shaped); rm $shaped\n" GROVE_BINARY
                    " load ws://$at/ --seconds 0.5 --width 320 --height 180 --json 2>/dev/null\n"
                    "kill -" +
                    std::string(signal) + " $shaper; wait $shaper");
    EXPECT_EQ(outcome.exit, 0) << signal;
    EXPECT_THAT(outcome.output, StartsWith("listening on 127.0.0.1:"));
    EXPECT_THAT(outcome.output, HasSubstr("\"errors\":0"));
  }
}

}  // namespace
}  // namespace grove::cli
