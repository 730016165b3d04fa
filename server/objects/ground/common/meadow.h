#pragma once

#include "objects/ground/common/pyramid.h"

namespace grove::objects::ground {

/// A patch of meadow seen from above that tiles without a seam.
///
/// Colour is the root of a factor on the clearing's albedo, in steps of kMeadowStep; alpha is the height of what grows
/// there (255 = kTallest).
struct Meadow {
  Pyramid pyramid;  ///< in blocks
  float metres;     ///< side of the tile
  float tallest;    ///< metres, of what grows there
};

inline constexpr float kMeadowStep = 1.41421356F / 255.0F;

/// Height that no grass exceeds, in metres.
inline constexpr float kTallest = 0.24F;

}  // namespace grove::objects::ground
