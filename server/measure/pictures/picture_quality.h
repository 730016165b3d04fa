#pragma once

#include <cstdint>
#include <span>
#include <vector>

/// Similarity of two pictures. Pictures are RGBA8 (bytes R, G, B, A), row by row. If there is a mask, only its non-zero
/// pixels count.
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

/// Returns the mask of pixels with coverage (A).
[[nodiscard]] Mask covered(const Picture& picture);

/// Returns the mean square error of red, green and blue, in bytes; 0 if the mask is empty.
[[nodiscard]] double meanSquareError(const Picture& a, const Picture& b, const Mask& mask);

/// Returns the PSNR in decibels for bytes; kEqual without error.
[[nodiscard]] double decibels(double meanSquareError);
inline constexpr double kEqual = 99.0;

/// Returns the structural similarity of the luma: Wang, Bovik, Sheikh, Simoncelli, "Image Quality Assessment: From
/// Error Visibility to Structural Similarity" (2004), with its 11 x 11 gaussian window; the mean over the mask. 1 is
/// equal. At the borders the window is clipped.
[[nodiscard]] double structuralSimilarity(const Picture& a, const Picture& b, const Mask& mask);

}  // namespace grove::measure
