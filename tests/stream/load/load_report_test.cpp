#include "stream/load/load_report.h"

#include <gmock/gmock.h>

#include "stream/protocol/protocol.h"

namespace grove::stream {
namespace {

using testing::ElementsAre;

TEST(LoadReport, MergesVisitors) {
  VisitorStatistics ada;
  ada.frames = 300;
  ada.bytes = 1'000'000;
  ada.dropped = 2;
  for (int i = 1; i <= 100; ++i) ada.latencyMilliseconds.push_back(static_cast<float>(i));
  ada.longestGapSeconds = 0.125;
  ada.shown = {{{kCodecH264, 720}, 200}, {{kCodecH264, 540}, 100}};
  VisitorStatistics bob;
  bob.frames = 100;
  bob.bytes = 250'000;
  for (int i = 1; i <= 100; ++i) bob.latencyMilliseconds.push_back(static_cast<float>(i + 100));
  bob.longestGapSeconds = 1.5;
  bob.shown = {{{kCodecJpeg, 360}, 100}};
  bob.errors = {"it rains"};
  ada.limitedSeconds = {{LimitedBy::kNothing, 6.0}, {LimitedBy::kLine, 4.0}};
  bob.limitedSeconds = {{LimitedBy::kMachine, 10.0}};

  const LoadReport report = summarise({{ada, bob}, 10.0, {"nobody there"}});
  EXPECT_EQ(report.sessions, 2);
  EXPECT_EQ(report.frames, 400U);
  EXPECT_EQ(report.fpsMin, 10.0);
  EXPECT_EQ(report.fpsP50, 10.0);
  EXPECT_EQ(report.latencyP50Milliseconds, 100.0);
  EXPECT_EQ(report.latencyP95Milliseconds, 190.0);
  EXPECT_EQ(report.latencyP99Milliseconds, 198.0);
  EXPECT_EQ(report.mbitPerSecond, 1.0);
  EXPECT_EQ(report.dropped, 2U);
  EXPECT_THAT(report.limitedShare,
              ElementsAre(testing::Pair(LimitedBy::kNothing, 0.3), testing::Pair(LimitedBy::kLine, 0.2),
                          testing::Pair(LimitedBy::kMachine, 0.5)));
  EXPECT_EQ(report.codec, "h264");
  EXPECT_EQ(report.linesMin, 360);
  EXPECT_EQ(report.linesP50, 540);
  EXPECT_EQ(report.longestGapMilliseconds, 1500.0);
  EXPECT_THAT(report.errors, ElementsAre("nobody there", "it rains"));
}

/// Who stands still may get no picture at all while it is counted.
TEST(LoadReport, UsesTheScreenSizeWithoutPictures) {
  VisitorStatistics still;
  still.screenAtFirst = {kCodecH264, 720};
  EXPECT_EQ(summarise({{still}, 10.0, {}}).codec, "h264");
  EXPECT_EQ(summarise({{still}, 10.0, {}}).linesMin, 720);
  still.shown = {{{kCodecJpeg, 360}, 1}};
  EXPECT_EQ(summarise({{still}, 10.0, {}}).codec, "jpeg");
  EXPECT_EQ(summarise({{still}, 10.0, {}}).linesP50, 360);
  EXPECT_EQ(summarise({{VisitorStatistics{}}, 10.0, {}}).linesMin, 0);
}

}  // namespace
}  // namespace grove::stream
