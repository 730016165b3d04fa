#include "objects/sky/backend/landscape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "objects/sky/common/panorama.h"

namespace grove::objects::sky {
namespace {

constexpr int kHeadings = 180;
constexpr float kSeed = 3.7F;

float headingOf(int i) { return 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / kHeadings; }

/// Returns how much of a forest that covers everything is seen: 0 where mist and air hide all of it.
float seenAt(float heading, float tangent) {
  const world::Sky sky;
  Skyline forest = skylineAt(heading, kSeed);
  forest.tops.fill(1.0F);
  const world::Vec3 direction = Panorama::direction(heading, tangent);
  const world::Vec3 haze = sky.hazeColour(direction);
  const world::Vec3 colour = landscapeOver(sky, {}, forest, direction, heading, tangent, 1e-3F, kSeed);
  return glm::length(colour - haze) / glm::length(haze);
}

/// Returns the tangent at which the mist hides half of what is seen high above it.
float mistTopAt(float heading) {
  const float half = 0.5F * seenAt(heading, 0.1F);
  constexpr int kSteps = 100;
  for (int step = 0; step < kSteps; ++step) {
    const float tangent = 1e-3F * static_cast<float>(step);
    if (seenAt(heading, tangent) > half) return tangent;
  }
  return 0.1F;
}

/// Fails if the mist ends at the same height in all directions, as if drawn with a ruler.
TEST(Landscape, MistLiesInBanks) {
  std::vector<float> tops;
  tops.reserve(kHeadings);
  for (int i = 0; i < kHeadings; ++i) tops.push_back(mistTopAt(headingOf(i)));
  std::ranges::sort(tops);
  EXPECT_LT(tops[kHeadings / 10], 0.7F * tops[kHeadings * 9 / 10]);
  EXPECT_GT(tops.front(), 0.0F) << "mist is everywhere";
}

/// Fails if a stripe of another colour lies between the ground, which haze hides at the horizon, and the landscape.
TEST(Landscape, HazeHidesTheHorizon) {
  for (int i = 0; i < kHeadings; ++i) EXPECT_LT(seenAt(headingOf(i), 0.0F), 0.06F) << headingOf(i);
}

}  // namespace
}  // namespace grove::objects::sky
