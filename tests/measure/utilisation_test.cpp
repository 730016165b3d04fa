#include "measure/utilisation.h"

#include <gtest/gtest.h>

#include <vector>

namespace grove::measure {
namespace {

using pipeline::TimelineEvent;
using pipeline::TraceTag;

constexpr std::int64_t kMs = 1'000'000;
constexpr Window kWindow{100 * kMs, 200 * kMs};

TimelineEvent run(const char* stage, TraceTag tag, std::int64_t beginMs, std::int64_t endMs, std::int64_t cpuMs = 0) {
  TimelineEvent event;
  event.stage = stage;
  event.tag = tag;
  event.beginNanoseconds = beginMs * kMs;
  event.wallNanoseconds = (endMs - beginMs) * kMs;
  event.cpuNanoseconds = cpuMs * kMs;
  return event;
}

TimelineEvent part(const char* stage, const char* type, std::int64_t beginMs, std::int64_t endMs, std::int64_t cpuMs) {
  TimelineEvent event = run(stage, {1, 1}, beginMs, endMs, cpuMs);
  event.subject = type;
  event.part = true;
  return event;
}

TEST(Utilisation, IsTheUnionOfIntervals) {
  const std::vector<TimelineEvent> events{
      run("Renderer", {1, 1}, 120, 140), run("Renderer", {2, 1}, 130, 150),  // overlap
      run("Renderer", {1, 2}, 135, 138),                                     // within
      run("Renderer", {1, 3}, 160, 170), run("Renderer", {2, 3}, 170, 180),  // touch
  };
  const auto stages = stageUse(events, kWindow);
  ASSERT_EQ(stages.size(), 1u);
  const Use& use = stages.at("Renderer").all;
  EXPECT_DOUBLE_EQ(use.utilisation, 0.5);
  EXPECT_EQ(use.runs, 5u);
  EXPECT_DOUBLE_EQ(use.wallMillisecondsPerRun, 63.0 / 5.0);
}

TEST(Utilisation, IsCutAtTheWindow) {
  const std::vector<TimelineEvent> events{run("Encoder", {1, 1}, 90, 110, 4), run("Encoder", {1, 2}, 190, 230, 8),
                                          run("Encoder", {1, 3}, 10, 20), run("Encoder", {1, 4}, 300, 310)};
  const Use use = stageUse(events, kWindow).at("Encoder").all;
  EXPECT_DOUBLE_EQ(use.utilisation, 0.2);
  EXPECT_EQ(use.runs, 1u) << "the one that ended within";
  EXPECT_DOUBLE_EQ(use.wallMillisecondsPerRun, 20.0);
  EXPECT_DOUBLE_EQ(use.cpuMillisecondsPerRun, 4.0);
}

// Fault: a stage that was idle during the window is missing in a report.
TEST(Utilisation, AnIdleStageHasNoRuns) {
  const std::vector<TimelineEvent> events{run("Renderer", {1, 1}, 10, 20, 4), run("Encoder", {1, 1}, 120, 130)};
  const auto stages = stageUse(events, kWindow);
  ASSERT_TRUE(stages.contains("Renderer"));
  EXPECT_EQ(stages.at("Renderer").all.runs, 0u);
  EXPECT_DOUBLE_EQ(stages.at("Renderer").all.utilisation, 0.0);
  EXPECT_EQ(bottleneck(stages), "Encoder");
}

TEST(Utilisation, PartsCountWithTheirStage) {
  const std::vector<TimelineEvent> events{
      part("Compositor", "fluid", 110, 120, 10), part("Compositor", "mesh", 120, 124, 2),
      part("Compositor", "mesh", 126, 128, 2),   run("Compositor", {1, 1}, 110, 130, 6),
      run("Compositor", {1, 1}, 140, 150, 4),
  };
  const StageUse stage = stageUse(events, kWindow).at("Compositor");
  EXPECT_EQ(stage.all.runs, 2u);
  EXPECT_DOUBLE_EQ(stage.all.wallMillisecondsPerRun, 15.0);
  EXPECT_DOUBLE_EQ(stage.all.cpuMillisecondsPerRun, 12.0) << "with its parts";
  EXPECT_DOUBLE_EQ(stage.all.utilisation, 0.3);
  ASSERT_EQ(stage.types.size(), 2u);
  EXPECT_EQ(stage.types.at("mesh").runs, 2u);
  EXPECT_DOUBLE_EQ(stage.types.at("mesh").wallMillisecondsPerRun, 3.0);
  EXPECT_DOUBLE_EQ(stage.types.at("mesh").cpuMillisecondsPerRun, 2.0);
  EXPECT_DOUBLE_EQ(stage.types.at("mesh").utilisation, 0.06);
  EXPECT_DOUBLE_EQ(stage.types.at("fluid").utilisation, 0.1);
}

TEST(Utilisation, BottleneckIsTheBusiestFrameStage) {
  const std::vector<TimelineEvent> events{run("Simulation Tick", {}, 100, 200), run("Renderer", {1, 1}, 100, 160),
                                          run("Encoder", {1, 1}, 160, 180)};
  EXPECT_EQ(bottleneck(stageUse(events, kWindow)), "Renderer");
  EXPECT_EQ(bottleneck({}), "");
}

TEST(DeliveredFrames, LatencyIsFromFirstRunToEncoding) {
  const std::vector<TimelineEvent> events{
      run("Scene Analyzer", {1, 1}, 80, 81),   run("Encoder", {1, 1}, 95, 99),    // before
      run("Scene Analyzer", {1, 2}, 90, 91),   run("Encoder", {1, 2}, 100, 120),  // began before
      run("Compositor", {1, 3}, 130, 150),     run("Scene Analyzer", {1, 3}, 120, 121),
      run("Encoder", {1, 3}, 150, 160),        run("Result Sender", {1, 3}, 125, 170),
      run("Scene Analyzer", {1, 4}, 150, 151),                                    // dropped
      run("Scene Analyzer", {2, 3}, 170, 171), run("Encoder", {2, 3}, 195, 205),  // after
      run("Simulation Tick", {}, 100, 110),
  };
  const auto frames = deliveredFrames(events, kWindow);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].tag.frame, 2u);
  EXPECT_DOUBLE_EQ(frames[0].milliseconds(), 30.0);
  EXPECT_EQ(frames[1].tag.frame, 3u);
  EXPECT_DOUBLE_EQ(frames[1].milliseconds(), 40.0);
  EXPECT_DOUBLE_EQ(overlap(frames, kWindow, 1), 0.7);
  EXPECT_DOUBLE_EQ(overlap(frames, kWindow, 2), 0.35);
}

}  // namespace
}  // namespace grove::measure
