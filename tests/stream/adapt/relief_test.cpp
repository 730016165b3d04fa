#include "stream/adapt/relief.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace grove::stream {
namespace {

constexpr double kWanted = 30.0;
constexpr std::array<Relief::Share, 4> kSteps = {{{1.0, 1.0}, {2.0 / 3.0, 1.0}, {2.0 / 3.0, 0.85}, {2.0 / 3.0, 0.6}}};

/// A browser that paints at most so many pixels a second, of pictures whose whole size counts 1.
struct Browser {
  double capacity;
  Relief relief{kSteps, 0.7};
  double now = 10.0;
  int changes = 0;

  Relief::Share run(double seconds) {
    for (const double end = now + seconds; now < end; now += 0.1) {
      const Relief::Share share = relief.share();
      const double sent = kWanted * share.rate;
      const double achieved = std::min(sent, capacity / (share.scale * share.scale));
      const double blocked = std::max(0.0, 1.0 - achieved / sent);
      changes += relief.update(now, blocked, achieved, kWanted) == share ? 0 : 1;
    }
    return relief.share();
  }
};

// Fault: relief for a browser that keeps up, or nearly: fewer frames than it can paint.
TEST(Relief, ToleratesNearlyFastBrowsers) {
  for (const double capacity : {40.0, 30.0, 22.0}) {
    EXPECT_EQ(Browser{capacity}.run(60.0), Relief::Share{}) << capacity;
  }
}

// Fault: pictures that get smaller before they get fewer; no relief at all.
TEST(Relief, ReducesRateBeforeSize) {
  const Relief::Share slow = Browser{18.0}.run(8.0);
  EXPECT_LT(slow.rate, 1.0);
  EXPECT_EQ(slow.scale, 1.0);
  const Relief::Share slower = Browser{8.0}.run(9.0);
  EXPECT_LT(slower.scale, 1.0);
  EXPECT_GE(20.0 * slower.scale * slower.scale, 5.0);
}

// Faults: relief that stays when the browser has time again; a try at every chance, each of which is seen.
TEST(Relief, EndsAndBacksOff) {
  Browser browser{14.0};
  browser.run(10.0);
  browser.changes = 0;
  browser.run(600.0);
  EXPECT_LT(browser.changes, 24);
  browser.capacity = 60.0;
  EXPECT_EQ(browser.run(900.0), Relief::Share{});
}

// Fault: relief a step at a time, for a browser that needs all of it: seconds with a few large frames.
TEST(Relief, ReducesAsMuchAsNeeded) {
  Browser browser{6.0};
  EXPECT_LT(browser.run(3.0).scale, 0.85);
  EXPECT_EQ(browser.changes, 1);
}

// Fault: larger pictures for a browser that paints just enough small ones: a stream that goes up and down for ever.
TEST(Relief, StaysWhileNeeded) {
  Browser browser{6.0};
  browser.run(3.0);
  browser.changes = 0;
  browser.run(600.0);
  EXPECT_EQ(browser.changes, 0);
}

}  // namespace
}  // namespace grove::stream
