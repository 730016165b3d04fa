#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/vector_bytes.h"

namespace grove::raster {

/// The weathered face of rock as heights in a cube that repeats: layers, grains and pits of eight texels down to two.
/// Baked once, for a lookup costs less than evaluating the noise anew at every pixel.
class DetailTexture {
 public:
  static constexpr std::uint32_t kBits = 6;
  static constexpr std::uint32_t kSize = 1U << kBits;  ///< texels along an edge

  DetailTexture();

  static constexpr std::uint32_t kLine = kSize + 1;

  /// At ((y * kSize) + x) * kLine + z: the heights (0..255) of the texel, of those next along x, along y, and along
  /// both, from the lowest byte up. The end of a line is its beginning again, so z + 1 needs no wrapping and both lie
  /// side by side.
  [[nodiscard]] const std::uint32_t* squares() const noexcept { return squares_.data(); }

  /// Memory that it takes.
  [[nodiscard]] std::size_t bytes() const noexcept { return pipeline::vectorBytes(squares_); }

 private:
  std::vector<std::uint32_t> squares_;
};

}  // namespace grove::raster
