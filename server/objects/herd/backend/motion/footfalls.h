#pragma once

#include <array>
#include <vector>

#include "objects/herd/backend/motion/course.h"
#include "objects/herd/common/animal_pose.h"

namespace grove::objects::herd {

/// Where the four feet of an animal are along a course, at one time; in the course's coordinates.
struct Feet {
  std::array<world::Vec3, kLegs> places{};  ///< y above the ground
  std::array<bool, kLegs> onGround{};
  float phase = 0.0F;  ///< strides so far
};

/// Plans footfalls: a foot comes down so that the leg's joint is above it in the middle of its stance, and stays there
/// until it lifts off. Feet do not slide, whatever the course does. An animal that stops steps until all its feet stand
/// below it.
[[nodiscard]] std::vector<Feet> planFootfalls(const Course& course, float phase, int stepsPerSecond);

}  // namespace grove::objects::herd
