#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "raster/image.h"

namespace grove::stream {

/// A picture as video codecs take it: luma, and chroma of half the width and height. BT.601, limited range. Width and
/// height are even.
struct I420 {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> bytes;  ///< Y, then U, then V, without gaps

  [[nodiscard]] std::uint8_t* y() noexcept { return bytes.data(); }
  [[nodiscard]] std::uint8_t* u() noexcept { return y() + lumaBytes(); }
  [[nodiscard]] std::uint8_t* v() noexcept { return u() + lumaBytes() / 4; }

  /// Becomes this image, whose alpha is not looked at; keeps its memory where that is enough.
  void assign(const raster::Image& image);

 private:
  [[nodiscard]] std::size_t lumaBytes() const noexcept {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
};

}  // namespace grove::stream
