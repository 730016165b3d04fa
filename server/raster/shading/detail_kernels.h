#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "raster/shading/detail.h"

namespace grove::raster {

inline constexpr std::size_t kDetailScales = 3;

/// One scale of the procedural detail, in the object's coordinates.
struct DetailScale {
  /// Rows of the matrix from object coordinates to texels.
  world::Vec3 texelX{0.0F};
  world::Vec3 texelY{0.0F};
  world::Vec3 texelZ{0.0F};
  /// Change of the logarithm of the brightness by a slope of one step of height (0..255) per texel: per unit of relief,
  /// and constant.
  world::Vec3 sun{0.0F};
  world::Vec3 up{0.0F};
  float stain = 0.0F;   ///< the same by one step of height
  float pixels = 0.0F;  ///< size of the smallest features at one metre
};

/// Maps a drawing's pixels to object coordinates.
struct DetailView {
  float nearDepth = 0.0F;
  /// The pixel (column, row) of the rectangle shows the point eye + depth * (corner + column * alongRow + row *
  /// downwards) in object coordinates.
  world::Vec3 eye{0.0F};
  world::Vec3 corner{0.0F};
  world::Vec3 alongRow{0.0F};
  world::Vec3 downwards{0.0F};
  std::array<DetailScale, kDetailScales> scales{};
};

/// finish() for rock: `squares` is a DetailTexture's. The image already has its spans.
void finishWeathered(const Fragments& fragments, const DetailView& view, const std::uint32_t* squares, Image& image);

/// finish() for surfaces without detail.
void finishPlain(const Fragments& fragments, float nearDepth, Image& image);

}  // namespace grove::raster
