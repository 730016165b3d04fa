#include "stream/load/load_client.h"

#include <gmock/gmock.h>

#include "pipeline/clocks.h"
#include "sanitized.h"
#include "stream/web_server/served_world.h"

namespace grove::stream {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

using LoadClientTest = ServedWorld;

LoadPlan plan(int sessions, double seconds) {
  LoadPlan plan;
  plan.sessions = sessions;
  plan.seconds = seconds;
  plan.width = 320;
  plan.height = 180;
  return plan;
}

TEST_F(LoadClientTest, MeasuresRealSessions) {
  const LoadReport report = summarise(runLoadClients({"127.0.0.1", port()}, plan(2, 1.0)));
  EXPECT_EQ(report.sessions, 2);
  EXPECT_THAT(report.errors, IsEmpty());
  EXPECT_GT(report.frames, 2U);
  EXPECT_GT(report.fpsMin, 0.0);
  EXPECT_GE(report.fpsP50, report.fpsMin);
  EXPECT_GT(report.latencyP50Milliseconds, 0.0);
  EXPECT_GE(report.latencyP99Milliseconds, report.latencyP50Milliseconds);
  EXPECT_GE(report.latencyP95Milliseconds, report.latencyP50Milliseconds);
  EXPECT_GT(report.mbitPerSecond, 0.0);
  EXPECT_GT(report.longestGapMilliseconds, 0.0);
  EXPECT_GE(report.linesP50, report.linesMin);
  EXPECT_GE(report.linesMin, 90);
  EXPECT_EQ(report.codec, "h264") << "the best that is offered";
  EXPECT_TRUE(becomesEmpty());
}

TEST_F(LoadClientTest, UsesTheRequestedCodec) {
  LoadPlan asked = plan(1, 0.5);
  asked.codecs = {kCodecJpeg};
  const LoadReport report = summarise(runLoadClients({"127.0.0.1", port()}, asked));
  EXPECT_THAT(report.errors, IsEmpty());
  EXPECT_EQ(report.codec, "jpeg");
}

// Faults: a sub-protocol that the library does not know; pictures with nearness that count as damaged.
TEST_F(LoadClientTest, TakesPicturesWithNearness) {
  LoadPlan asked = plan(1, 0.5);
  asked.lateWalk = true;
  const LoadReport report = summarise(runLoadClients({"127.0.0.1", port()}, asked));
  EXPECT_THAT(report.errors, IsEmpty());
  EXPECT_GT(report.frames, 2U);
}

/// Who stands still gets pictures, or word that none are needed.
TEST_F(LoadClientTest, MeasuresLatencyWhileStanding) {
  LoadPlan still = plan(1, 1.5);
  still.movement = Movement::kStand;
  const LoadReport report = summarise(runLoadClients({"127.0.0.1", port()}, still));
  EXPECT_THAT(report.errors, IsEmpty());
  EXPECT_GT(report.latencyP50Milliseconds, 0.0);
}

TEST_F(LoadClientTest, MeasuresOverAShapedLine) {
  LoadPlan shaped = plan(2, 1.0);
  shaped.shape = std::get<LinkProfile>(parseLinkProfile("3mbit,150ms,jitter=10ms"));
  const LoadReport report = summarise(runLoadClients({"127.0.0.1", port()}, shaped));
  EXPECT_EQ(report.sessions, 2);
  EXPECT_THAT(report.errors, IsEmpty());
  EXPECT_GT(report.frames, 2U);
  EXPECT_GE(report.latencyP50Milliseconds, 150.0) << "from an input to a picture is once there and back";
  EXPECT_LE(report.mbitPerSecond, 2 * 3.0 * 1.3) << "a line each, and what was queued before counting";
  EXPECT_TRUE(becomesEmpty());
}

TEST_F(LoadClientTest, WalksToTheStartBeforeMeasuring) {
  LoadPlan walking = plan(2, 0.5);
  walking.follow.emplace(WalkToFollow{world::parseWalk("0 5 -5 0 0\n4 2 -5 1 0\n", "test"), {}, 0.0F});
  const LoadReport report = summarise(runLoadClients({"127.0.0.1", port()}, walking));
  EXPECT_EQ(report.sessions, 2);
  EXPECT_THAT(report.errors, IsEmpty());
  EXPECT_LT(report.seconds, 5.0);
}

/// There are so many sessions that less than a millisecond lies between two inputs: clients that do not sleep through
/// it poll all the time.
TEST_F(LoadClientTest, SleepsBetweenInputs) {
  if (kSanitized) GTEST_SKIP() << "a sanitizer's own time is counted, too";
  LoadPlan still = plan(24, 1.0);
  still.movement = Movement::kStand;
  still.codecs = {kCodecJpeg};
  const std::int64_t began = pipeline::threadCpuNanoseconds();
  const LoadReport report = summarise(runLoadClients({"127.0.0.1", port()}, still));
  const double used = static_cast<double>(pipeline::threadCpuNanoseconds() - began) * 1e-9;
  EXPECT_EQ(report.sessions, kMaxVisitors);
  EXPECT_LT(used, 0.15)
      << "seconds of a core: 0.04 if it sleeps, 0.18 and more if it spins, even where cores are short";
}

TEST_F(LoadClientTest, CountsRefusedSessions) {
  const LoadReport report = summarise(runLoadClients({"127.0.0.1", port()}, plan(kMaxVisitors + 2, 0.3)));
  EXPECT_EQ(report.sessions, kMaxVisitors);
  EXPECT_EQ(report.errors.size(), 2U);
  EXPECT_THAT(report.errors, Contains(HasSubstr("4002")));
}

TEST_F(LoadClientTest, ReportsWhyNoSessionConnected) {
  server_.stop();
  const LoadReport report = summarise(runLoadClients({"127.0.0.1", port()}, plan(2, 0.3)));
  EXPECT_EQ(report.sessions, 0);
  ASSERT_EQ(report.errors.size(), 2U);
  EXPECT_FALSE(report.errors.front().empty());
}

}  // namespace
}  // namespace grove::stream
