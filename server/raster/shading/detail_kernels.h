#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "raster/shading/detail.h"

namespace grove::raster {

inline constexpr std::size_t kDetailScales = 3;

/// One scale of the procedural detail, in the object's coordinates.
struct DetailScale {
  /// Rows of the matrix that turns a place into texels.
  world::Vec3 texelX{0.0F};
  world::Vec3 texelY{0.0F};
  world::Vec3 texelZ{0.0F};
  /// How much a slope of one step of height (0..255) a texel changes the logarithm of the brightness: by a unit of
  /// relief, and wherever it is.
  world::Vec3 sun{0.0F};
  world::Vec3 up{0.0F};
  float stain = 0.0F;   ///< how much a step of height does
  float pixels = 0.0F;  ///< that the smallest features have at one metre
};

/// How a drawing's pixels are found on the object.
struct DetailView {
  float nearDepth = 0.0F;
  /// The pixel (column, row) of the rectangle shows eye + depth * (corner + column * alongRow + row * downwards), in
  /// the object's coordinates.
  world::Vec3 eye{0.0F};
  world::Vec3 corner{0.0F};
  world::Vec3 alongRow{0.0F};
  world::Vec3 downwards{0.0F};
  std::array<DetailScale, kDetailScales> scales{};
};

/// As finish() says, of rock: `squares` is a DetailTexture's. The image has its spans already.
void finishWeathered(const Fragments& fragments, const DetailView& view, const std::uint32_t* squares, Image& image);

/// As finish() says, of what shows no detail.
void finishPlain(const Fragments& fragments, float nearDepth, Image& image);

}  // namespace grove::raster
