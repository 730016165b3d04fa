#pragma once

#include "objects/ground/common/clearing.h"
#include "objects/ground/common/meadow.h"

namespace grove::objects::ground {

/// Maps that are baked once and shared by all visitors.
struct GroundMaps {
  Clearing clearing;
  Meadow meadow;
};

}  // namespace grove::objects::ground
