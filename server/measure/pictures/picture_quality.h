#pragma once

#include <cstdint>
#include <span>
#include <vector>

/// How alike two pictures are. Pictures are RGBA8 (bytes R, G, B, A), row by row; where a mask is given, only its
/// pixels that are not 0 count.
namespace grove::measure {

struct Picture {
  std::span<const std::uint32_t> colour;
  int width = 0;

  [[nodiscard]] int height() const noexcept { return width > 0 ? static_cast<int>(colour.size()) / width : 0; }
};

using Mask = std::vector<std::uint8_t>;

/// ITU-R BT.601.
[[nodiscard]] constexpr double lumaOf(double red, double green, double blue) noexcept {
  return 0.299 * red + 0.587 * green + 0.114 * blue;
}

/// Pixels whose coverage (A) is not 0.
[[nodiscard]] Mask covered(const Picture& picture);

/// Mean square error of red, green and blue, of bytes; 0 if the mask is empty.
[[nodiscard]] double meanSquareError(const Picture& a, const Picture& b, const Mask& mask);

/// Decibels, of bytes; kEqual if there is no error.
[[nodiscard]] double decibels(double meanSquareError);
inline constexpr double kEqual = 99.0;

/// Structural similarity of the luma: Wang, Bovik, Sheikh, Simoncelli, "Image Quality Assessment: From Error Visibility
/// to Structural Similarity" (2004), with its 11 x 11 gaussian window; the mean over the mask. 1 is equal. At the
/// borders the window is the part of it that lies within.
[[nodiscard]] double structuralSimilarity(const Picture& a, const Picture& b, const Mask& mask);

}  // namespace grove::measure
