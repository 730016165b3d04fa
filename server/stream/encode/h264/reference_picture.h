#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stream/encode/h264/macroblock.h"

namespace grove::stream::h264 {

/// One plane with a border on all sides.
struct BorderedPlane {
  int width = 0;
  int height = 0;
  int border = 0;
  std::ptrdiff_t stride = 0;
  std::vector<std::uint8_t> bytes = {};

  /// `x` and `y` may lie in the border.
  [[nodiscard]] std::uint8_t* at(int x, int y) { return bytes.data() + offset(x, y); }
  [[nodiscard]] const std::uint8_t* at(int x, int y) const { return bytes.data() + offset(x, y); }

 private:
  [[nodiscard]] std::ptrdiff_t offset(int x, int y) const { return (y + border) * stride + x + border; }
};

/// A picture as a decoder reconstructs it: whole macroblocks, and around them a border that repeats their edges.
class ReferencePicture {
 public:
  /// Pixels of luma.
  static constexpr int kBorder = 64;

  ReferencePicture() = default;
  ReferencePicture(int macroblocksAcross, int macroblocksDown);

  /// 0: Y, 1: U, 2: V.
  [[nodiscard]] BorderedPlane& plane(std::size_t i) { return planes_[i]; }
  [[nodiscard]] const BorderedPlane& plane(std::size_t i) const { return planes_[i]; }

  /// Fills the border beside luma rows from `top` to before `bottom`, even numbers, and above or below the picture if
  /// they touch it.
  void extend(int top, int bottom);

  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  std::array<BorderedPlane, 3> planes_;
};

}  // namespace grove::stream::h264
