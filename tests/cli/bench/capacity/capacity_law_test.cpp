#include "cli/bench/capacity/capacity_law.h"

#include <gtest/gtest.h>

namespace grove::cli {
namespace {

/// A trial of ten seconds at 30 frames per second.
CapacityTrial trial(int visitors, bool privateWorlds, double cpuCores) {
  CapacityTrial made{.visitors = visitors, .privateWorlds = privateWorlds, .load = {}, .cpuCores = cpuCores};
  made.load.sessions = visitors;
  made.load.seconds = 10.0;
  made.load.frames = static_cast<std::uint64_t>(300 * visitors);
  made.load.fpsP50 = 30.0;
  made.load.latencyP99Milliseconds = 60.0;
  made.load.linesMin = 720;
  return made;
}

/// A world of 0.4 cores, and 0.2 for each visitor.
double cores(int visitors) { return 0.4 + 0.2 * visitors; }

TEST(CapacityLaw, RecoversAlphaOfKnownCosts) {
  const std::vector<CapacityTrial> trials{trial(1, false, cores(1)),       trial(1, true, 9.0),
                                          trial(4, false, cores(4)),       trial(8, false, cores(8) - 0.1),
                                          trial(8, false, cores(8) + 0.1), trial(9, false, 2.0)};
  const auto law = capacityLaw(trials, 8);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->alpha, 0.4 / 0.6, 1e-9);
  // Two cores serve 8 who share; one world each takes 0.6.
  EXPECT_NEAR(law->privateMin, 2.0 / 0.6, 1e-9);
  EXPECT_NEAR(law->privateMax, 2.2 / 0.6, 1e-9);
  EXPECT_FALSE(law->agrees(2));
  EXPECT_TRUE(law->agrees(3));
  EXPECT_FALSE(law->agrees(4));
}

TEST(CapacityLaw, NeedsTwoSharedVisitors) {
  EXPECT_FALSE(capacityLaw({trial(1, false, cores(1))}, 1));
  EXPECT_FALSE(capacityLaw({}, 0));
}

/// Would catch a capacity that counts smaller pictures, or visitors who were not let in.
TEST(CapacityTrial, NeedsAllLimits) {
  const PictureSize size{1280, 720};
  const CapacityTrial good = trial(4, false, 1.0);
  EXPECT_TRUE(good.isServed(size));
  const auto changed = [&](auto change) {
    CapacityTrial made = good;
    change(made.load);
    return made.isServed(size);
  };
  EXPECT_FALSE(changed([](auto& load) { load.fpsP50 = 28.9; }));
  EXPECT_FALSE(changed([](auto& load) { load.latencyP99Milliseconds = 100.5; }));
  EXPECT_FALSE(changed([](auto& load) { load.linesMin = 600; }));
  EXPECT_FALSE(changed([](auto& load) { load.sessions = 3; }));
  EXPECT_FALSE(changed([](auto& load) { load.errors.emplace_back("the connection broke"); }));
}

}  // namespace
}  // namespace grove::cli
