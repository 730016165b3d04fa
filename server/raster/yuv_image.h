#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "raster/image.h"

namespace grove::raster {

// Colours for encoders: luma, and chroma at half width and height, rows from the top. BT.601 full range, as in JPEG
// (JFIF 1.02). Edges of rectangles are even.

/// What the two kinds of planes share.
struct LumaImage {
  world::Rect rect;
  Plane<std::uint8_t> bytes;  ///< Y, then the chroma, without gaps

  [[nodiscard]] int width() const noexcept { return rect.width(); }
  [[nodiscard]] int height() const noexcept { return rect.height(); }
  [[nodiscard]] std::size_t lumaBytes() const noexcept {
    return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  }
  [[nodiscard]] std::uint8_t* y() noexcept { return bytes.data(); }
  [[nodiscard]] const std::uint8_t* y() const noexcept { return bytes.data(); }
  /// Offset of a pixel's luma; both coordinates are even.
  [[nodiscard]] std::ptrdiff_t lumaAt(int x, int y) const noexcept {
    return std::ptrdiff_t{y - rect.top} * width() + (x - rect.left);
  }
};

/// A rectangle of a frame in three planes: Y, U, V.
struct YuvImage : LumaImage {
  [[nodiscard]] std::uint8_t* u() noexcept { return y() + lumaBytes(); }
  [[nodiscard]] std::uint8_t* v() noexcept { return u() + lumaBytes() / 4; }
  [[nodiscard]] const std::uint8_t* u() const noexcept { return y() + lumaBytes(); }
  [[nodiscard]] const std::uint8_t* v() const noexcept { return u() + lumaBytes() / 4; }
  /// Offset of a pixel's U and V; both coordinates are even.
  [[nodiscard]] std::ptrdiff_t chromaAt(int x, int y) const noexcept {
    return std::ptrdiff_t{(y - rect.top) / 2} * (width() / 2) + (x - rect.left) / 2;
  }
};

/// A rectangle of a frame in two planes; U and V of a pixel are adjacent.
struct SemiPlanarImage : LumaImage {
  [[nodiscard]] std::uint8_t* uv() noexcept { return y() + lumaBytes(); }
  [[nodiscard]] const std::uint8_t* uv() const noexcept { return y() + lumaBytes(); }
  /// Offset of a pixel's pair of U and V; both coordinates are even.
  [[nodiscard]] std::ptrdiff_t chromaAt(int x, int y) const noexcept {
    return std::ptrdiff_t{(y - rect.top) / 2} * width() + (x - rect.left);
  }
};

/// Memory from the pool; the contents are undefined.
[[nodiscard]] std::shared_ptr<YuvImage> acquireYuv(ImagePool& pool, const world::Rect& rect);
[[nodiscard]] std::shared_ptr<SemiPlanarImage> acquireSemiPlanar(ImagePool& pool, const world::Rect& rect);

/// Converts colours within `part`, which lies within both; alpha is ignored.
void toYuv(const Image& from, const world::Rect& part, YuvImage& to);
/// Converts all colours of `from`, which lies within `to`.
void toSemiPlanar(const Image& from, SemiPlanarImage& to);
/// Copies a part that both contain.
void copyPart(const SemiPlanarImage& from, const world::Rect& part, SemiPlanarImage& to);
void copyPart(const SemiPlanarImage& from, const world::Rect& part, YuvImage& to);
void copyPart(const YuvImage& from, const world::Rect& part, YuvImage& to);

/// Converts colours within `part`, which lies within both, to opaque ones. Repeats chroma, so that toYuv() restores the
/// original values up to rounding.
void toRgba(const YuvImage& from, const world::Rect& part, Image& to);

/// Converts all colours to opaque ones.
[[nodiscard]] std::vector<std::uint32_t> rgbaOf(const YuvImage& image);

}  // namespace grove::raster
