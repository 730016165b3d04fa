#include "cli/bench/amortize/course.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "world/players.h"

namespace grove::cli {
namespace {

/// Where visitors are after so many seconds.
std::vector<world::Vec3> placesAfter(Course course, int visitors, double seconds) {
  world::Players players({0.0F, 0.0F, 0.0F}, 0.0F, 1000.0F, {});
  std::vector<world::PlayerId> ids;
  ids.reserve(static_cast<std::size_t>(visitors));
  for (int i = 0; i < visitors; ++i) ids.push_back(players.join("visitor", 0.0));
  constexpr double kStep = 0.05;
  const auto steps = static_cast<std::uint32_t>(seconds / kStep);
  for (std::uint32_t number = 1; number <= steps; ++number) {
    const double now = kStep * (number - 1);
    for (int i = 0; i < visitors; ++i) {
      world::Input input = controlsOn(course, i, 0.0F, now);
      input.number = number;
      players.apply(ids[static_cast<std::size_t>(i)], input, now);
    }
  }
  std::vector<world::Vec3> places;
  places.reserve(ids.size());
  for (const world::PlayerId id : ids) places.push_back(players.find(id, seconds)->pose.position);
  return places;
}

float nearestTwo(const std::vector<world::Vec3>& places) {
  float nearest = 1e9F;
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, glm::distance(places[i], places[j]));
  }
  return nearest;
}

/// Would catch visitors apart who share views because they walk side by side.
TEST(Course, VisitorsApartAreFarFromEachOther) {
  EXPECT_GT(nearestTwo(placesAfter(Course::kApart, 4, 10.0)), 4.0F);
  EXPECT_LT(nearestTwo(placesAfter(Course::kTogether, 4, 10.0)), 2.0F);
}

TEST(Course, StandingVisitorsDoNotMove) {
  const auto before = placesAfter(Course::kStanding, 2, 0.1);
  const auto after = placesAfter(Course::kStanding, 2, 10.0);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_LT(glm::distance(before[i], after[i]), 1e-3F);
}

TEST(Course, HasAName) {
  for (const auto& [name, course] : kCourses) EXPECT_EQ(nameOf(course), name);
}

}  // namespace
}  // namespace grove::cli
