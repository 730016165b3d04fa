#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "world/camera.h"
#include "world/ground/hills.h"

namespace grove::world {

/// An unusable walk file; what() reads `FILE:LINE: reason`.
class WalkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Position and direction of an eye over the time of a walk. Immutable.
class Walk {
 public:
  struct Step {
    double seconds = 0.0;
    Pose pose;
  };
  /// At least one step, in order of time, the first at 0 or later.
  explicit Walk(std::vector<Step> steps);

  /// Interpolates linearly between two steps and turns the shorter way; returns the first or last pose outside their
  /// times.
  [[nodiscard]] Pose at(double seconds) const;
  /// Goes there and back, repeatedly.
  [[nodiscard]] Pose thereAndBack(double seconds) const;
  /// Time of the last step.
  [[nodiscard]] double seconds() const noexcept { return steps_.back().seconds; }

 private:
  std::vector<Step> steps_;
};

/// Raises a pose of a walk, whose height counts from the ground below.
[[nodiscard]] Pose onGround(Pose pose, std::span<const Hill> hills) noexcept;

/// Reads a walk: lines of `seconds x z yaw pitch`, or `seconds x y z yaw pitch`, metres and radians as in Pose; without
/// y, the eye is at a visitor's height. Heights count from the ground. `#` begins a comment. Throws WalkError (bad
/// file) or EnvironmentError (no such file, not a regular file, or more than 16 MiB).
[[nodiscard]] Walk loadWalk(const std::filesystem::path& file);

/// The same from text; `fileName` is for messages.
[[nodiscard]] Walk parseWalk(std::string_view text, const std::string& fileName);

}  // namespace grove::world
