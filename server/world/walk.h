#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "world/camera.h"

namespace grove::world {

/// A file of a walk that cannot be used; what() reads `FILE:LINE: reason`.
class WalkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Where somebody's eye was, and where he looked, at each time of a walk. Immutable.
class Walk {
 public:
  struct Step {
    double seconds = 0.0;
    Pose pose;
  };
  /// One step at least, in the order of time, the first at 0 or later.
  explicit Walk(std::vector<Step> steps);

  /// Between two steps, on the straight line between them, turning the short way round; before the first and after the
  /// last one, there.
  [[nodiscard]] Pose at(double seconds) const;
  /// There and back again, for ever.
  [[nodiscard]] Pose thereAndBack(double seconds) const;
  /// Of the last step.
  [[nodiscard]] double seconds() const noexcept { return steps_.back().seconds; }

 private:
  std::vector<Step> steps_;
};

/// Reads a walk: lines of `seconds x z yaw pitch`, or `seconds x y z yaw pitch`, metres and radians as in Pose; without
/// y, the eye is where that of a visitor is. `#` begins a comment. Throws WalkError (bad file) or EnvironmentError (no
/// such file, no plain one, or more than 16 MiB).
[[nodiscard]] Walk loadWalk(const std::filesystem::path& file);

/// The same from text; `fileName` is for messages.
[[nodiscard]] Walk parseWalk(std::string_view text, const std::string& fileName);

}  // namespace grove::world
