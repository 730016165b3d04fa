#include "pipeline/timeline.h"

#include <gtest/gtest.h>

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

TEST(Timeline, CountsWhatIsNoTime) {
  Timeline timeline;
  timeline.count("hits");
  timeline.count("hits", 4);
  timeline.count("misses");
  EXPECT_EQ(timeline.counters(), (std::map<std::string, std::int64_t>{{"hits", 5}, {"misses", 1}}));
}

TEST(Timeline, NamesOfWorkAreThePapersTerms) {
  EXPECT_EQ(toString(Work::kAcrossUser), "across-user");
  EXPECT_EQ(toString(Work::kPerUserBackend), "per-user-backend");
  EXPECT_EQ(toString(Work::kPerUserFrontend), "per-user-frontend");
}

}  // namespace
}  // namespace grove::pipeline
