#pragma once

#include "objects/ground/common/pyramid.h"

namespace grove::objects::ground {

/// A seamless tile of meadow seen from above.
///
/// Colour is the square root of a factor on the clearing's albedo, in steps of kMeadowStep; alpha is the height of the
/// plants (255 = kTallest).
struct Meadow {
  Pyramid pyramid;  ///< see Pyramid::inBlocks()
  float metres;     ///< side of the tile
  float tallest;    ///< metres, of the plants in this tile
};

inline constexpr float kMeadowStep = 1.41421356F / 255.0F;

/// Upper bound of the grass's height, in metres.
inline constexpr float kTallest = 0.24F;

}  // namespace grove::objects::ground
