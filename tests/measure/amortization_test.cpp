#include "measure/amortization.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace grove::measure {
namespace {

/// A column of the paper's Figure 5.6, milliseconds, and the shares it prints.
struct Column {
  double ci, cb0, cb1, cf;
  double alpha0, alpha1;
};
constexpr std::array<Column, 4> kFigure56 = {{
    {67.11, 0.76, 17.95, 9.56, 0.87, 0.71},
    {49.14, 1.61, 37.09, 4.98, 0.88, 0.54},
    {59.88, 0.61, 14.58, 7.77, 0.88, 0.73},
    {63.94, 2.72, 59.32, 9.69, 0.84, 0.48},
}};

TEST(Amortization, MatchesFigure56OfThePaper) {
  for (const Column& column : kFigure56) {
    const FrameCost cost{column.ci, 0.0, column.cb0, column.cb1 - column.cb0, column.cf};
    EXPECT_NEAR(cost.backendCompressed(), column.cb1, 1e-12);
    EXPECT_NEAR(alpha0(cost), column.alpha0, 0.005);
    EXPECT_NEAR(alpha1(cost), column.alpha1, 0.005);
  }
}

TEST(Amortization, MatchesBetaOfThePaper) {
  const double lightField = 3.0e9;
  EXPECT_NEAR(acrossUserShare(lightField, 32.0e6, 2.0e6), 0.989, 0.0005);
  const double fluid = 64.0 * 64.0 * 64.0 * 12.0 + 5000.0 * 24.0;
  EXPECT_NEAR(acrossUserShare(fluid, 0.0, 5000.0 * 24.0), 0.965, 0.0005);
}

TEST(Amortization, EmptyInputGivesZero) { EXPECT_EQ(acrossUserShare(0.0, 0.0, 0.0), 0.0); }

TEST(Amortization, LawPredictsPrivateVisitors) {
  EXPECT_DOUBLE_EQ(privateVisitors(10.0, 0.9), 1.9);
  EXPECT_DOUBLE_EQ(privateVisitors(7.0, 0.0), 7.0) << "nothing is shared, nothing is saved";
  EXPECT_DOUBLE_EQ(privateVisitors(1.0, 0.7), 1.0) << "one visitor shares with nobody";
}

void record(pipeline::Timeline& timeline, const char* stage, const char* subject, pipeline::Work work, int runs,
            double milliseconds) {
  for (int i = 0; i < runs; ++i) {
    pipeline::TimelineEvent event;
    event.stage = stage;
    event.subject = subject;
    event.work = work;
    event.cpuNanoseconds = static_cast<std::int64_t>(milliseconds * 1.0e6);
    timeline.record(event);
  }
}

double cpuBetween(const Reading& before, const Reading& after) {
  double milliseconds = 0.0;
  for (const auto& [key, total] : after.costs) milliseconds += 1e-6 * static_cast<double>(total.cpuNanoseconds);
  for (const auto& [key, total] : before.costs) milliseconds -= 1e-6 * static_cast<double>(total.cpuNanoseconds);
  return milliseconds;
}

/// Would catch ticks that count at a rate that did not happen, and work that is in two classes or in none.
TEST(Amortization, ReportsFrameCostPerObjectType) {
  using pipeline::Work;
  pipeline::Timeline timeline;
  record(timeline, "Simulation Tick", "fluid", Work::kAcrossUser, 100, 99.0);  // before: does not count
  const Reading before = Reading::of(timeline);
  // Two visitors got 60 frames each, while a slow machine did 30 ticks of 10 ms.
  record(timeline, "Simulation Tick", "fluid", Work::kAcrossUser, 30, 10.0);
  record(timeline, "Shared View", "lightfield", Work::kOnDemand, 120, 3.0);
  record(timeline, "Renderer", "lightfield", Work::kPerUserBackend, 120, 2.0);
  record(timeline, "Compressor", "fluid", Work::kPerUserBackend, 120, 0.5);
  record(timeline, "Compositor", "fluid", Work::kPerUserFrontend, 120, 4.0);
  record(timeline, "Encoder", "", Work::kPerUserFrontend, 120, 3.0);
  timeline.countReuse("lightfield", {.made = 120, .shared = 40, .madeBytes = 1200, .sharedBytes = 600});
  const Reading after = Reading::of(timeline);
  const auto costs = frameCosts(before, after, {.visitors = 2, .frames = 120.0});
  EXPECT_NEAR(costs.at("fluid").acrossUser, 5.0, 1e-9) << "a tick in two frames";
  EXPECT_NEAR(costs.at("fluid").compressor, 0.5, 1e-9);
  EXPECT_NEAR(costs.at("fluid").frontend, 4.0, 1e-9);
  EXPECT_NEAR(costs.at("lightfield").acrossUser, 3.0, 1e-9) << "half of what was made while one visitor got a frame";
  EXPECT_NEAR(costs.at("lightfield").onDemandShared, 3.0, 1e-9);
  EXPECT_NEAR(costs.at("lightfield").backend, 2.0 + 1.5, 1e-9) << "and the rest, which each has for himself";
  EXPECT_NEAR(costs.at("lightfield").onDemandOwn, 1.5, 1e-9);
  EXPECT_NEAR(costs.at("").frontend, 3.0, 1e-9);
  const FrameCost all = sum(costs);
  EXPECT_NEAR(all.perUser(), 11.0, 1e-9);
  EXPECT_NEAR(all.independent(), 5.0, 1e-9);
  EXPECT_NEAR(alpha1(all), 8.0 / 19.0, 1e-9);
  EXPECT_NEAR(alpha0(all), 8.0 / 18.5, 1e-9);
  EXPECT_NEAR(all.acrossUser * 60.0 + all.perUser() * 120.0, cpuBetween(before, after), 1e-6);
}

/// Would catch a lone visitor who shares with himself.
TEST(Amortization, ViewsOfOneVisitorAreHisOwn) {
  using pipeline::Work;
  pipeline::Timeline timeline;
  const Reading before = Reading::of(timeline);
  record(timeline, "Shared View", "lightfield", Work::kOnDemand, 10, 3.0);
  timeline.countReuse("lightfield", {.made = 10, .used = 10, .madeBytes = 100, .usesAgain = 500});
  const FrameCost cost = sum(frameCosts(before, Reading::of(timeline), {.visitors = 1, .frames = 30.0}));
  EXPECT_EQ(alpha1(cost), 0.0);
  EXPECT_NEAR(cost.backend, 1.0, 1e-9);
}

TEST(Amortization, DividesSharedMemoryAmongVisitors) {
  using pipeline::Work;
  pipeline::MemoryLedger ledger;
  const pipeline::HeldMemory state(ledger, "fluid state", "fluid", Work::kAcrossUser, 4000);
  const pipeline::HeldMemory views(ledger, "shared views", "lightfield", Work::kOnDemand, 1000);
  const pipeline::HeldMemory targets(ledger, "targets", "fluid", Work::kPerUserBackend, 200);
  const pipeline::HeldMemory images(ledger, "images", "", Work::kPerUserFrontend, 800);
  const auto shared = memoryShares(ledger, 2);
  EXPECT_EQ(shared.at("fluid").acrossUser, 4000.0);
  EXPECT_EQ(shared.at("fluid").perUserBackend, 100.0);
  EXPECT_NEAR(sum(shared).beta(), 5000.0 / 5500.0, 1e-12) << "one store of views for all";
}

}  // namespace
}  // namespace grove::measure
