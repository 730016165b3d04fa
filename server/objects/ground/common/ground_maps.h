#pragma once

#include <vector>

#include "objects/ground/common/clearing.h"
#include "objects/ground/common/meadow.h"
#include "world/ground/hills.h"

namespace grove::objects::ground {

/// Maps that are baked once and shared by all visitors.
struct GroundMaps {
  Clearing clearing;
  Meadow meadow;
  std::vector<world::Hill> hills = {};  ///< that the ground is made of
};

}  // namespace grove::objects::ground
