#pragma once

#include <limits>
#include <vector>

#include "objects/herd/backend/motion/root_move.h"

namespace grove::objects::herd {

/// A value that changes smoothly from one to another within some time, and back if it ends.
struct Ramp {
  float from = 0.0F;
  float to = 0.0F;
  float begin = 0.0F;  ///< seconds
  float end = 1.0F;
  float back = std::numeric_limits<float>::infinity();  ///< when it begins to change back

  [[nodiscard]] float at(float seconds) const noexcept {
    const float there = glm::smoothstep(begin, end, seconds);
    const float again = seconds <= back ? 0.0F : glm::smoothstep(0.0F, end - begin, seconds - back);
    return from + (to - from) * (there - again);
  }
};

/// Way of a root over time: how fast it goes ahead and turns, integrated in fine steps.
class Course {
 public:
  /// From `begin` (0 or before) to `end`, seconds; at time 0 the root is at the origin and faces -Z.
  Course(const Ramp& speed, const Ramp& turn, float begin, float end);

  /// Outside its time, where it begins or ends.
  [[nodiscard]] RootMove at(float seconds) const noexcept;
  [[nodiscard]] float speed(float seconds) const noexcept { return speed_.at(seconds); }
  /// Radians per second, to the left.
  [[nodiscard]] float turn(float seconds) const noexcept { return turn_.at(seconds); }
  [[nodiscard]] float begin() const noexcept { return begin_; }
  [[nodiscard]] float end() const noexcept { return end_; }

 private:
  const Ramp speed_;
  const Ramp turn_;
  const float begin_;
  const float end_;
  std::vector<RootMove> roots_;  ///< kSteps per second
};

}  // namespace grove::objects::herd
