#pragma once

#include <cstddef>
#include <cstdint>

#include "world/geometry.h"

namespace grove::objects::herd {

/// Texels of a shadow mask's side, and floats for all of them: vectors at the end may be read beyond the last.
inline constexpr int kMaskSide = 48;
inline constexpr std::size_t kMaskFloats = (std::size_t{kMaskSide} + 1) * kMaskSide + 16;

/// A thick line in a mask, in texels.
struct FlatCapsule {
  world::Vec2 from;
  world::Vec2 way;  ///< to the other end
  float fromRadius;
  float toRadius;
  float soft;  ///< half the width of its edge
};

/// Kernel: raises each texel of kMaskFloats, in rows of kMaskSide, to the share that a capsule covers, 0..1.
void coverCapsule(const FlatCapsule& capsule, float* cover);

/// Kernel: packs each texel with its right and lower neighbours, see SunMask::texels(). What is beyond the last row and
/// column has no meaning: places there are not looked up.
void packFours(const float* cover, std::uint32_t* fours);

}  // namespace grove::objects::herd
