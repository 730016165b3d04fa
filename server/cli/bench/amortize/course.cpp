#include "cli/bench/amortize/course.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "stream/session/stroll.h"

namespace grove::cli {
namespace {

/// The golden angle in radians: any number of visitors part in directions that differ.
constexpr float kParting = 2.39996F;

}  // namespace

std::string nameOf(Course course) {
  return std::ranges::find(kCourses, course, &std::pair<const std::string, Course>::second)->first;
}

world::Input controlsOn(Course course, int index, float yaw, double seconds) {
  world::Input input;
  input.yaw = yaw;
  if (course == Course::kStanding) return input;
  if (course == Course::kTogether) return stream::stroll(index, yaw, seconds);
  input.yaw += kParting * static_cast<float>(index);
  // Ahead is the edge of the world, and less work behind a frame.
  if (seconds >= kMaxWarmUp) return stream::stroll(index, input.yaw + std::numbers::pi_v<float>, seconds);
  input.keys = world::kForward | world::kRun;
  return input;
}

}  // namespace grove::cli
