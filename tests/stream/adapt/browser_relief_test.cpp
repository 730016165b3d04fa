#include "stream/adapt/browser_relief.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace grove::stream {
namespace {

constexpr double kWanted = 30.0;

/// A browser that paints at most so many pixels a second, of pictures whose whole size counts 1.
struct Browser {
  double capacity;
  BrowserRelief relief{};
  double now = 10.0;
  int changes = 0;

  BrowserRelief::Share run(double seconds) {
    for (const double end = now + seconds; now < end; now += 0.1) {
      const BrowserRelief::Share share = relief.share();
      const double sent = kWanted * share.rate;
      const double achieved = std::min(sent, capacity / (share.scale * share.scale));
      const double blocked = std::max(0.0, 1.0 - achieved / sent);
      changes += relief.update(now, blocked, achieved, kWanted) == share ? 0 : 1;
    }
    return relief.share();
  }
};

// Fault: relief for a browser that keeps up, or nearly: fewer frames than it can paint.
TEST(BrowserRelief, LeavesABrowserAloneThatNearlyKeepsUp) {
  for (const double capacity : {40.0, 30.0, 22.0}) {
    EXPECT_EQ(Browser{capacity}.run(60.0), BrowserRelief::Share{}) << capacity;
  }
}

// Fault: pictures that get smaller before they get fewer; no relief at all.
TEST(BrowserRelief, SparesFramesFirstAndThenPixels) {
  const BrowserRelief::Share slow = Browser{18.0}.run(8.0);
  EXPECT_LT(slow.rate, 1.0);
  EXPECT_EQ(slow.scale, 1.0);
  const BrowserRelief::Share slower = Browser{8.0}.run(9.0);
  EXPECT_LT(slower.scale, 1.0);
  EXPECT_GE(20.0 * slower.scale * slower.scale, 5.0);
}

// Faults: relief that stays when the browser has time again; a try at every chance, each of which is seen.
TEST(BrowserRelief, EndsWhenItIsNotNeededAndIsTriedEverMoreSeldom) {
  Browser browser{14.0};
  browser.run(10.0);
  browser.changes = 0;
  browser.run(600.0);
  EXPECT_LT(browser.changes, 24);
  browser.capacity = 60.0;
  EXPECT_EQ(browser.run(900.0), BrowserRelief::Share{});
}

}  // namespace
}  // namespace grove::stream
