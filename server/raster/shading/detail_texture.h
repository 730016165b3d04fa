#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/vector_bytes.h"

namespace grove::raster {

/// Weathered rock as heights in a repeating cube: layers, grains and pits of eight texels down to two. Baked once,
/// because a look-up costs less than evaluating noise at every pixel.
class DetailTexture {
 public:
  static constexpr std::uint32_t kBits = 6;
  static constexpr std::uint32_t kSize = 1U << kBits;  ///< texels per edge

  DetailTexture();

  static constexpr std::uint32_t kLine = kSize + 1;

  /// At ((y * kSize) + x) * kLine + z: the heights (0..255) of the texel, its neighbours along x and along y, and the
  /// diagonal one, from the lowest byte up. The start of a line repeats at its end, so z + 1 needs no wrapping and both
  /// are adjacent.
  [[nodiscard]] const std::uint32_t* squares() const noexcept { return squares_.data(); }

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept { return pipeline::vectorBytes(squares_); }

 private:
  std::vector<std::uint32_t> squares_;
};

}  // namespace grove::raster
