#include "pipeline/timeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "pipeline/clocks.h"

namespace grove::pipeline {
namespace {

TEST(Timeline, KeepsTheNewestEventsAndAllTotals) {
  Timeline timeline(3);
  for (int i = 1; i <= 5; ++i) {
    TimelineEvent event;
    event.stage = "stage";
    event.beginNanoseconds = i;
    event.cpuNanoseconds = 10;
    timeline.record(event);
  }
  const auto events = timeline.events();
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events.front().beginNanoseconds, 3);
  EXPECT_EQ(events.back().beginNanoseconds, 5);
  EXPECT_EQ(timeline.totals().at("stage").runs, 5u);
  EXPECT_EQ(timeline.totals().at("stage").cpuNanoseconds, 50);
}

TEST(Timeline, ReadsEventsInOrderDuringRecording) {
  Timeline timeline(1000);
  std::atomic<bool> done = false;
  std::thread recorder([&] {
    for (std::int64_t i = 0; !done; ++i) {
      TimelineEvent event;
      event.stage = "stage";
      event.beginNanoseconds = i;
      timeline.record(event);
    }
  });
  while (timeline.totals()["stage"].runs < 2000) std::this_thread::yield();
  const auto isBefore = [](const TimelineEvent& a, const TimelineEvent& b) {
    return a.beginNanoseconds < b.beginNanoseconds;
  };
  for (int i = 0; i < 200; ++i) {
    const auto events = timeline.events(700);
    EXPECT_LE(events.size(), 700U);
    EXPECT_TRUE(std::ranges::is_sorted(events, isBefore));
  }
  done = true;
  recorder.join();
  const auto events = timeline.events(700);
  ASSERT_EQ(events.size(), 700U);
  EXPECT_EQ(events.back().beginNanoseconds - events.front().beginNanoseconds, 699);
}

void useCpu(std::int64_t nanoseconds) {
  const std::int64_t begin = threadCpuNanoseconds();
  while (threadCpuNanoseconds() - begin < nanoseconds) {
  }
}

TEST(Timeline, NestedRunsCountOnce) {
  constexpr std::int64_t kPiece = 2'000'000;
  Timeline timeline;
  const std::int64_t begin = threadCpuNanoseconds();
  {
    const TimedRun outer(timeline, "Compositor", Work::kPerUserFrontend, {});
    useCpu(kPiece);
    {
      const TimedRun part(timeline, "Compositor", Work::kPerUserFrontend, {}, "fluid");
      useCpu(2 * kPiece);
      const TimedRun other(timeline, "Shared View", Work::kOnDemand, {}, "lightfield");
      useCpu(4 * kPiece);
    }
  }
  const std::int64_t all = threadCpuNanoseconds() - begin;
  const auto costs = timeline.costs();
  const std::int64_t outer = costs.at({"Compositor", ""}).cpuNanoseconds;
  const std::int64_t part = costs.at({"Compositor", "fluid"}).cpuNanoseconds;
  const std::int64_t other = costs.at({"Shared View", "lightfield"}).cpuNanoseconds;
  EXPECT_GE(outer, kPiece);
  EXPECT_GE(part, 2 * kPiece);
  EXPECT_GE(other, 4 * kPiece);
  EXPECT_LE(outer + part + other, all);
  EXPECT_EQ(timeline.totals().at("Compositor").runs, 1u) << "a part of a run is no run";
  EXPECT_EQ(timeline.totals().at("Compositor").cpuNanoseconds, outer + part);
  EXPECT_EQ(costs.at({"Shared View", "lightfield"}).runs, 1u);
  EXPECT_EQ(costs.at({"Shared View", "lightfield"}).work, Work::kOnDemand);
}

TEST(Timeline, InterleavedPartsAreOneEventPerSubject) {
  constexpr std::int64_t kPiece = 2'000'000;
  Timeline timeline;
  const std::int64_t begin = threadCpuNanoseconds();
  std::int64_t helped = 0;
  {
    const TimedRun run(timeline, "Compositor", Work::kPerUserFrontend, {});
    const auto parts = [&] {
      TimedParts times(timeline, "Compositor", Work::kPerUserFrontend, {});
      for (int turn = 0; turn < 3; ++turn) {
        times.turnTo("sky");
        useCpu(kPiece);
        times.turnTo("fluid");
        times.turnTo("fluid");
        useCpu(2 * kPiece);
      }
    };
    parts();
    useCpu(kPiece);
    std::thread([&] {
      parts();
      helped = threadCpuNanoseconds();
    }).join();
  }
  const std::int64_t all = threadCpuNanoseconds() - begin + helped;
  const auto costs = timeline.costs();
  const std::int64_t rest = costs.at({"Compositor", ""}).cpuNanoseconds;
  const std::int64_t sky = costs.at({"Compositor", "sky"}).cpuNanoseconds;
  const std::int64_t fluid = costs.at({"Compositor", "fluid"}).cpuNanoseconds;
  EXPECT_GE(sky, 6 * kPiece);
  EXPECT_GE(fluid, 12 * kPiece);
  EXPECT_GE(rest, kPiece);
  EXPECT_LE(rest + sky + fluid, all) << "every nanosecond once";
  EXPECT_EQ(timeline.totals().at("Compositor").runs, 1U);
  const auto events = timeline.events();
  ASSERT_EQ(events.size(), 5U) << "two of each thread, and the run";
  EXPECT_EQ(events[0].subject, "sky");
  EXPECT_EQ(events[1].subject, "fluid");
  EXPECT_EQ(events[1].beginNanoseconds, events[0].beginNanoseconds + events[0].wallNanoseconds);
  EXPECT_NE(events[2].thread, events[0].thread);
}

TEST(Timeline, SeparatesNestedRunsOfOtherTimelines) {
  Timeline one;
  Timeline two;
  {
    const TimedRun outer(one, "outer", Work::kAcrossUser, {});
    const TimedRun inner(two, "inner", Work::kAcrossUser, {});
  }
  EXPECT_EQ(one.totals().size(), 1u);
  EXPECT_EQ(two.totals().size(), 1u);
}

TEST(Timeline, HasCounters) {
  Timeline timeline;
  timeline.count("hits");
  timeline.count("hits", 4);
  timeline.count("misses");
  EXPECT_EQ(timeline.counters(), (std::map<std::string, std::int64_t>{{"hits", 5}, {"misses", 1}}));
}

TEST(Timeline, WorkHasThePapersTerms) {
  EXPECT_EQ(toString(Work::kAcrossUser), "across-user");
  EXPECT_EQ(toString(Work::kPerUserBackend), "per-user-backend");
  EXPECT_EQ(toString(Work::kPerUserFrontend), "per-user-frontend");
  EXPECT_EQ(toString(Work::kOnDemand), "on-demand");
}

}  // namespace
}  // namespace grove::pipeline
