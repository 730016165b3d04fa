#pragma once

#include <cstddef>
#include <cstdint>

#include "world/geometry.h"

namespace grove::objects::figure {

/// A straight line through a grid of texels, of which there are at least two in each direction.
struct TexelLine {
  const std::uint16_t* texels;  ///< 65535: 1
  int columns;                  ///< texels from one row to the next
  int rows;
  world::Vec2 first;  ///< column and row of the first place; texels are at whole numbers
  world::Vec2 step;   ///< from one place to the next
};

/// Kernel: adds `weight` times the texels, interpolated, at the first `count` places of a line. Of places beyond the
/// grid, those at its edges. Floats beyond the last, up to kShadePadding, are read, and do not change.
void addTexels(const TexelLine& line, float weight, int count, float* sums);
inline constexpr std::size_t kShadePadding = 16;

/// The look of a shade.
struct ShadeLook {
  world::Vec3 colour;  ///< of what the sky lights alone, displayed, 0..1
  float depth;         ///< metres
};

/// Kernel: puts a shade behind each of a row's pixels. `sun` and `sky` are what the ground there lacks of the light of
/// the sun and of the whole sky, 0..1; the greater counts. Where the sun is missing, pixels before the shade get its
/// depth if it is less: blades of grass that hide boots are as bright as in the sun.
void layShades(const float* sun, const float* sky, const ShadeLook& look, int count, std::uint32_t* colour,
               float* depth);

}  // namespace grove::objects::figure
