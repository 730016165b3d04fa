#include "stream/session/frame_cadence.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace grove::stream {
namespace {

constexpr double kPeriod = 1.0 / 30.0;

/// Begins frames as soon as they are due and the previous one has taken its time; returns how many begin within
/// `seconds` if every tenth takes `slow` and the others take `fast`.
int framesIn(double seconds, double slow, double fast) {
  FrameCadence cadence;
  int frames = 0;
  double now = 0.0;
  while (now < seconds) {
    cadence.begins(now, kPeriod);
    now = std::max(cadence.due(), now + (++frames % 10 == 0 ? slow : fast));
  }
  return frames;
}

// Fault: each frame that takes longer than a period costs a frame, also where the others leave room for it.
TEST(FrameCadence, MakesUpForLateFrames) {
  EXPECT_NEAR(framesIn(10.0, 0.12, 0.015), 300, 3);
  EXPECT_NEAR(framesIn(10.0, 0.03, 0.015), 300, 1) << "no more than were wanted";
}

// Fault: frames come in bursts that no page shows.
TEST(FrameCadence, MakesUpAtTwiceTheRateAtMost) {
  FrameCadence cadence;
  cadence.begins(0.0, kPeriod);
  EXPECT_DOUBLE_EQ(cadence.due(), kPeriod);
  cadence.begins(0.2, kPeriod);
  EXPECT_DOUBLE_EQ(cadence.due(), 0.2 + kPeriod / 2);
}

// Fault: a page that was hidden for a minute gets a minute's frames.
TEST(FrameCadence, ForgetsALongPause) {
  FrameCadence cadence;
  cadence.begins(0.0, kPeriod);
  double now = 60.0;
  int early = 0;
  for (; early < 100; ++early) {
    cadence.begins(now, kPeriod);
    if (cadence.due() > now + 0.9 * kPeriod) break;
    now = cadence.due();
  }
  EXPECT_NEAR(early, 2.0 * FrameCadence::kMaxMissed, 2.0) << "each takes half a period";
}

}  // namespace
}  // namespace grove::stream
