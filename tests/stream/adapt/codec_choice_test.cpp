#include "stream/adapt/codec_choice.h"

#include <gtest/gtest.h>

namespace grove::stream {
namespace {

constexpr double kJpeg = 25e6;

/// What a stream measures, on a line of so many bits a second.
struct CodecSituation {
  double line;
  bool isWorkScarce;
  bool isBrowserShort = false;  ///< with JPEG
  bool isStill = false;
};

struct ChosenStream {
  CodecChoice choice{};
  double now = 10.0;
  int changes = 0;

  bool run(double seconds, const CodecSituation& situation) {
    for (const double end = now + seconds; now < end; now += 0.1) {
      const bool before = choice.savesWork();
      const double sent = before ? kJpeg : 4e6;
      choice.update(now, {.isWorkScarce = situation.isWorkScarce && !before,
                          .isBrowserShort = situation.isBrowserShort && before,
                          .isStill = situation.isStill,
                          .isLineScarce = situation.line < sent,
                          .lineBitsPerSecond = situation.line,
                          .provenBitsPerSecond = situation.line,
                          .workSaverBitsPerSecond = kJpeg});
      changes += choice.savesWork() == before ? 0 : 1;
    }
    return choice.savesWork();
  }
};

// Faults: work that is saved where it is not scarce; bits that are spent where the line has none to spare.
TEST(CodecChoice, SavesCpuOnlyIfScarceAndTheLineIsFast) {
  EXPECT_FALSE((ChosenStream{}.run(60.0, {200e6, false})));
  EXPECT_FALSE((ChosenStream{}.run(60.0, {6e6, true})));
  EXPECT_TRUE((ChosenStream{}.run(5.0, {200e6, true})));
}

// Faults: 25 Mbit/s for a view that stands still; a browser that needs longer for a JPEG and gets it all the same.
TEST(CodecChoice, SavesBitsForStillViewsAndSlowBrowsers) {
  ChosenStream still;
  ASSERT_TRUE(still.run(5.0, {200e6, true}));
  EXPECT_FALSE(still.run(0.3, {200e6, true, false, true}));
  EXPECT_FALSE(still.run(60.0, {200e6, true, false, true}));
  EXPECT_TRUE(still.run(5.0, {200e6, true}));
  ChosenStream slow;
  slow.run(1200.0, {200e6, true, true});
  EXPECT_FALSE(slow.choice.savesWork());
  EXPECT_LE(slow.changes, 14);
}

// Fault: a moment's shortage that changes the codec.
TEST(CodecChoice, WaitsBeforeAChange) {
  ChosenStream stream;
  for (int i = 0; i < 50; ++i) {
    stream.run(0.5, {200e6, true});
    stream.run(0.5, {200e6, false});
  }
  EXPECT_EQ(stream.changes, 0);
}

// Faults: a line that gets worse and goes on getting JPEG; one that is tried again and again though it never carries
// it.
TEST(CodecChoice, GoesBackOnASlowLine) {
  ChosenStream stream;
  ASSERT_TRUE(stream.run(5.0, {200e6, true}));
  EXPECT_FALSE(stream.run(3.0, {8e6, true}));
  stream.changes = 0;
  stream.run(1200.0, {15e6, true});
  EXPECT_LE(stream.changes, 12);
}

// Fault: one shortage, after which bits are wasted for ever; work that is scarce again each time bits are saved, and a
// codec that changes every minute for it.
TEST(CodecChoice, RetriesWithBackoff) {
  ChosenStream stream;
  ASSERT_TRUE(stream.run(5.0, {200e6, true}));
  EXPECT_FALSE(stream.run(70.0, {200e6, false}));
  ChosenStream busy;
  busy.run(3600.0, {200e6, true});
  EXPECT_LE(busy.changes, 16);
}

}  // namespace
}  // namespace grove::stream
