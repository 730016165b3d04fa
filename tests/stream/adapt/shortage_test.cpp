#include "stream/adapt/shortage.h"

#include <gtest/gtest.h>

namespace grove::stream {
namespace {

/// Frames of 30 a second, each of which waits for `who` so long; seconds. Returns when the last one began.
double run(Shortage& shortage, double from, double seconds, LimitedBy who, double wait) {
  constexpr double kRate = 30.0;
  constexpr double kLook = 0.004;
  double now = from;
  for (int frame = 0; frame < static_cast<int>(seconds * kRate); ++frame) {
    const double due = from + frame / kRate;
    for (int look = 0; look * kLook < wait; ++look) shortage.blocked(who, due + look * kLook);
    now = due + wait;
    shortage.began(now);
  }
  return now;
}

// Faults: time that is counted for somebody else, or that keeps no relation to what passed.
TEST(Shortage, MeasuresShareOfWaits) {
  for (const LimitedBy who : {LimitedBy::kLine, LimitedBy::kMachine, LimitedBy::kBrowser}) {
    Shortage shortage;
    const double now = run(shortage, 10.0, 12.0, who, 0.4 / 30.0);
    EXPECT_NEAR(shortage.share(who, now), 0.4, 0.03);
    EXPECT_EQ(shortage.main(now), who);
    for (const LimitedBy other : {LimitedBy::kLine, LimitedBy::kMachine, LimitedBy::kBrowser}) {
      if (other == who) continue;
      EXPECT_EQ(shortage.share(other, now), 0.0);
    }
    EXPECT_NEAR(shortage.framesPerSecond(), 30.0, 0.5);
  }
}

// Fault: somebody is blamed for a stream that is as good as it could be.
TEST(Shortage, IgnoresShortWaits) {
  Shortage shortage;
  EXPECT_EQ(shortage.main(run(shortage, 10.0, 12.0, LimitedBy::kMachine, 0.1 / 30.0)), LimitedBy::kNothing);
}

// Faults: a shortage that is never forgotten; one that lasts and counts only when a frame begins at last.
TEST(Shortage, FadesAndGrowsWithoutAFrame) {
  Shortage shortage;
  double now = run(shortage, 10.0, 12.0, LimitedBy::kLine, 0.5 / 30.0);
  now = run(shortage, now, 6.0, LimitedBy::kLine, 0.0);
  EXPECT_LT(shortage.share(LimitedBy::kLine, now), 0.02);
  shortage.blocked(LimitedBy::kMachine, now);
  EXPECT_GT(shortage.share(LimitedBy::kMachine, now + 3.0), 0.8);
}

// Fault: a frame's wait for the server that holds what it waited for the line, or for what came before.
TEST(Shortage, ReturnsWaitForTheServer) {
  Shortage shortage;
  shortage.blocked(LimitedBy::kLine, 1.0);
  shortage.blocked(LimitedBy::kMachine, 1.010);
  EXPECT_NEAR(shortage.began(1.014), 0.004, 1e-9);
  EXPECT_EQ(shortage.began(1.050), 0.0);
}

}  // namespace
}  // namespace grove::stream
