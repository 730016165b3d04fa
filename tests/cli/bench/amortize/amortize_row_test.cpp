#include "cli/bench/amortize/amortize_row.h"

#include <gtest/gtest.h>

namespace grove::cli {
namespace {

AmortizeRow rowOf(double frames, double acrossUser, float latency) {
  AmortizeRow row;
  row.users = 1;
  row.seconds = 10.0;
  row.frames = frames;
  row.fpsMin = frames / 10.0;
  row.latencies = {latency};
  row.costs["fluid"] = {.acrossUser = acrossUser,
                        .onDemandShared = 1.0,
                        .backend = 0.5,
                        .compressor = 0.25,
                        .frontend = 4.0,
                        .onDemandOwn = 0.125};
  row.memory["fluid"] = {.acrossUser = 8e6, .perUserBackend = 1e6, .perUserFrontend = 2e6};
  row.reuse = {
      .made = 9, .used = 8, .shared = 2, .madeBytes = 90, .sharedBytes = 20, .usesAgain = 70, .usesByOthers = 5};
  row.tick = 7.0;
  row.reportedBytes = 11e6;
  row.process = {.resident = 100, .proportional = 60};
  row.traffic = {.toBackend = 1, .pictures = 2, .sharedData = 3, .headers = 4};
  row.cpuCores = 0.5;
  row.stageCores = 0.4;
  row.driverCores = 0.01;
  return row;
}

// Fault: a figure is lost on its way from the process that has measured it.
TEST(AmortizeRow, RoundTrips) {
  const AmortizeRow sent = rowOf(300.0, 20.0, 31.5F);
  const AmortizeRow received = unpackRow(pack(sent));
  EXPECT_EQ(received.latencies, sent.latencies);
  EXPECT_EQ(received.costs.at("fluid").acrossUser, 20.0);
  EXPECT_EQ(received.costs.at("fluid").onDemandShared, 1.0);
  EXPECT_EQ(received.costs.at("fluid").onDemandOwn, 0.125);
  EXPECT_EQ(received.reuse, sent.reuse);
  EXPECT_EQ(received.tick, 7.0);
  EXPECT_EQ(received.costs.at("fluid").perUser(), 4.75);
  EXPECT_EQ(received.memory.at("fluid").beta(), sent.memory.at("fluid").beta());
  EXPECT_EQ(received.process.proportional, 60);
  EXPECT_EQ(received.traffic.toFrontend(), 9U);
  EXPECT_EQ(received.coresNeeded(), sent.coresNeeded());
  EXPECT_EQ(received.otherCores(), sent.otherCores());
}

// Fault: private mode counts one copy of what each visitor has, or the mean of what all use.
TEST(AmortizeRow, PrivateVisitorsAddUp) {
  const AmortizeRow all = together({rowOf(300.0, 20.0, 30.0F), rowOf(240.0, 24.0, 50.0F)});
  EXPECT_EQ(all.users, 2);
  EXPECT_TRUE(all.privateWorlds);
  EXPECT_DOUBLE_EQ(all.seconds, 10.0);
  EXPECT_DOUBLE_EQ(all.fps(), 27.0);
  EXPECT_DOUBLE_EQ(all.fpsMin, 24.0);
  EXPECT_DOUBLE_EQ(all.cost().acrossUser, (300.0 * 20.0 + 240.0 * 24.0) / 540.0) << "a frame counts, not a process";
  EXPECT_EQ(all.reuse.usesByOthers, 10U);
  EXPECT_DOUBLE_EQ(all.cost().perUser(), 4.75);
  EXPECT_DOUBLE_EQ(all.memory.at("fluid").acrossUser, 8e6);
  EXPECT_EQ(all.process.resident, 200);
  EXPECT_EQ(all.process.proportional, 120);
  EXPECT_DOUBLE_EQ(all.cpuCores, 1.0);
  EXPECT_FLOAT_EQ(static_cast<float>(all.latency(1.0)), 50.0F);
  const double ticks = (300.0 * 19.0 + 240.0 * 23.0) * 1e-4;  // a copy for each
  EXPECT_NEAR(all.coresNeeded(), ticks + (1.0 - ticks) * 30.0 / 27.0, 1e-9);
}

}  // namespace
}  // namespace grove::cli
