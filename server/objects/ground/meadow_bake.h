#pragma once

#include "objects/ground/pyramid.h"

namespace grove::objects::ground {

/// A patch of meadow seen from above that tiles without a seam.
///
/// Colour is a factor on the clearing's albedo (128 = 1), alpha is the height of what grows there (255 = kTallest).
struct Meadow {
  Pyramid pyramid;
  float metres;  ///< side of the tile
};

/// Height of the tallest grass in metres.
inline constexpr float kTallest = 0.24F;

/// Grows `size` x `size` texels of blades, clover and a few flowers on `metres` x `metres`.
[[nodiscard]] Meadow bakeMeadow(int size, float metres, int seed);

}  // namespace grove::objects::ground
