#pragma once

#include <cstdint>

#include "objects/herd/backend/motion/clip.h"
#include "objects/herd/backend/motion/course.h"

namespace grove::objects::herd {

/// What happens in a clip: an animal goes and turns, and changes from what it does while it stands to something else.
struct ClipPlan {
  Ramp speed;  ///< metres per second
  Ramp turn;   ///< radians per second, to the left
  Activity from = Activity::kStand;
  Activity to = Activity::kStand;
  float change = 0.4F;  ///< when it begins to change, seconds
  float changeSeconds = 0.8F;
  float seconds = 3.0F;
  float phase = 0.0F;      ///< of the stride at the beginning
  std::uint32_t seed = 0;  ///< of glances, ears and tail
};

/// Makes a clip by rules: footfalls by the gait, trunk and neck by phase and speed, glances by noise. The same plan
/// gives the same clip.
[[nodiscard]] Clip makeClip(const ClipPlan& plan);

}  // namespace grove::objects::herd
