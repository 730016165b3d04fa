#include "measure/amortization_meter.h"

#include <gtest/gtest.h>

namespace grove::measure {
namespace {

using pipeline::Work;

void record(pipeline::Timeline& timeline, const char* stage, Work work, int runs, double milliseconds) {
  for (int i = 0; i < runs; ++i) {
    pipeline::TimelineEvent event;
    event.stage = stage;
    event.work = work;
    event.cpuNanoseconds = static_cast<std::int64_t>(milliseconds * 1.0e6);
    timeline.record(event);
  }
}

TEST(AmortizationMeter, ReportsNothingWithoutVisitors) {
  const pipeline::Timeline timeline;
  const pipeline::MemoryLedger memory;
  AmortizationMeter meter(timeline, memory, 30.0);
  EXPECT_FALSE(meter.newest());
  meter.sample(0);
  meter.sample(0);
  EXPECT_FALSE(meter.newest());
}

TEST(AmortizationMeter, ReportsOnlyRecentSamples) {
  pipeline::Timeline timeline;
  const pipeline::MemoryLedger memory;
  AmortizationMeter meter(timeline, memory, 30.0);
  meter.sample(1);
  record(timeline, "Encoder", Work::kPerUserFrontend, 100, 50.0);  // long ago
  for (int i = 0; i < 6; ++i) {
    meter.sample(2);
    record(timeline, "Encoder", Work::kPerUserFrontend, 60, 3.0);
    record(timeline, "Simulation Tick", Work::kAcrossUser, 30, 6.0);
    timeline.countReuse("lightfield", {.made = 2, .used = 2, .usesByOthers = 1});
  }
  meter.sample(2);
  const auto measured = meter.newest();
  ASSERT_TRUE(measured);
  EXPECT_DOUBLE_EQ(measured->visitors, 2.0);
  EXPECT_NEAR(sum(measured->costs).frontend, 3.0, 1e-9);
  EXPECT_NEAR(sum(measured->costs).acrossUser, 6.0, 1e-9);
  EXPECT_EQ(sum(measured->reuse).made, 10U) << "between the six samples that are kept";
}

TEST(AmortizationMeter, ClocksDoNotWaitForSlowFrames) {
  Amortization measured;
  measured.visitors = 2.0;
  measured.framesPerSecond = 3.0;
  measured.costs["fluid"] = {.acrossUser = 100.0, .frontend = 5.0};  // ten ticks of 10 ms in a frame
  measured.cpuCores = (30.0 * 10.0 + 2 * 3.0 * 5.0) / 1000.0;
  EXPECT_NEAR(unreportedCost(measured), 0.0, 1e-9) << "all of its CPU is accounted for";
  EXPECT_NEAR(capacityOf(measured, 30.0).visitor, 0.15, 1e-9);
  EXPECT_NEAR(capacityOf(measured, 30.0).base, 0.3, 1e-9) << "no more ticks at the full frame rate";
}

TEST(AmortizationMeter, ReportsCapacity) {
  Amortization measured;
  measured.visitors = 4.0;
  measured.framesPerSecond = 30.0;
  measured.costs["fluid"] = {.acrossUser = 10.0};
  measured.costs["lightfield"] = {.acrossUser = 8.0, .onDemandShared = 8.0, .backend = 1.0};
  measured.costs[""] = {.frontend = 4.0};
  measured.cpuCores = 30.0 * (18.0 + 4 * 5.0) / 1000.0 + 0.12;  // a tenth of a core that no stage knows
  const Capacity capacity = capacityOf(measured, 30.0);
  EXPECT_NEAR(capacity.base, 0.54, 1e-9);
  EXPECT_NEAR(capacity.visitor, 0.15 + 0.03, 1e-9);
  EXPECT_NEAR(capacity.privateVisitor, 0.03 * (10.0 + 2.0) + 0.18, 1e-9)
      << "his tick, and a quarter of the pictures that four had made";
  EXPECT_EQ(capacity.visitorsFit(2.0 / Capacity::kUsableShare), 8);
  EXPECT_EQ(capacity.privateVisitorsFit(2.0 / Capacity::kUsableShare), 3);
  EXPECT_EQ(capacity.visitorsFit(0.1), 0);
}

/// Would catch a promise of whole pictures by what small ones cost.
TEST(AmortizationMeter, ScalesCostOfSmallerPictures) {
  const Capacity half = atFullSize({.base = 0.5, .visitor = 0.1, .privateVisitor = 0.3}, 0.5);
  EXPECT_NEAR(half.base, 0.5, 1e-9);
  EXPECT_NEAR(half.visitor, 0.4, 1e-9);
  EXPECT_NEAR(half.privateVisitor, 0.6, 1e-9);
  EXPECT_NEAR(atFullSize(half, 1.0).visitor, 0.4, 1e-9);
}

/// Would catch a promise that the present visitors refute.
TEST(AmortizationMeter, CapacityIsBoundedByMeasuredLoad) {
  EXPECT_EQ(correctedFit(9, 4, false, true), 3) << "four have smaller pictures";
  EXPECT_EQ(correctedFit(2, 4, false, true), 2);
  EXPECT_EQ(correctedFit(5, 1, false, true), 0) << "one is too many";
  EXPECT_EQ(correctedFit(3, 4, true, false), 4) << "four are served";
  EXPECT_EQ(correctedFit(9, 4, true, false), 9);
  EXPECT_EQ(correctedFit(9, 4, false, false), 9) << "they wait for something else";
}

}  // namespace
}  // namespace grove::measure
