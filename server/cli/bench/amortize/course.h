#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "world/players.h"

namespace grove::cli {

/// How the visitors of a row move: what they share depends on it.
enum class Course : std::uint8_t {
  kTogether,  ///< all stroll about where they arrive
  kApart,     ///< each runs in a direction of his own, turns round, and strolls about there
  kStanding,  ///< all look ahead from where they arrive
};

inline const std::map<std::string, Course> kCourses{
    {"together", Course::kTogether}, {"apart", Course::kApart}, {"standing", Course::kStanding}};
[[nodiscard]] std::string nameOf(Course course);

/// Longest warm-up of a row in seconds, in which visitors who walk apart part.
inline constexpr double kMaxWarmUp = 4.0;

/// Returns the controls of visitor `index`, who arrived with `yaw`, `seconds` after the start.
[[nodiscard]] world::Input controlsOn(Course course, int index, float yaw, double seconds);

}  // namespace grove::cli
