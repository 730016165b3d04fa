#pragma once

#include "objects/ground/common/meadow.h"

namespace grove::objects::ground {

/// Grows `size` x `size` texels, at least 16 x 16, of blades, clover and a few flowers on `metres` x `metres`.
[[nodiscard]] Meadow bakeMeadow(int size, float metres, int seed);

}  // namespace grove::objects::ground
