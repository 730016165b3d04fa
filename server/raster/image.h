#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "pipeline/memory_ledger.h"
#include "world/camera.h"

namespace grove::raster {

/// Columns of one row of an image, from `begin` to before `end`.
struct Span {
  int begin = 0;
  int end = 0;
};

/// Colour and depth of a rectangle of a frame, rows from the top, in memory.
///
/// Colour is RGBA8 (bytes R, G, B, A), display-encoded and premultiplied by A = coverage. Depth is view depth in
/// metres, kInfiniteDepth where there is nothing.
struct Image {
  world::Rect rect;
  std::span<std::uint32_t> colour;
  std::span<float> depth;
  bool opaque = false;  ///< promises that every pixel's A is 255, which makes compositing cheaper
  /// By row, what may show anything; pixels outside of it are never read. Empty: all of every row.
  std::vector<Span> spans;

  [[nodiscard]] int width() const noexcept { return rect.width(); }
  [[nodiscard]] int height() const noexcept { return rect.height(); }
  [[nodiscard]] Span span(int row) const noexcept {
    return spans.empty() ? Span{0, width()} : spans[static_cast<std::size_t>(row)];
  }
  [[nodiscard]] std::uint32_t* colourRow(int row) const noexcept {
    return colour.data() + std::ptrdiff_t{row} * width();
  }
  [[nodiscard]] float* depthRow(int row) const noexcept { return depth.data() + std::ptrdiff_t{row} * width(); }
};

/// Hands out images and takes their memory back when the last reference goes, so that no frame allocates or clears.
/// Keeps at most `maxBytes` of unused memory. Any thread; images may outlive the pool, and then the ledger.
class ImagePool {
 public:
  static constexpr std::size_t kUsualBytes = std::size_t{256} << 20U;

  explicit ImagePool(std::size_t maxBytes = kUsualBytes);
  /// Reports all memory of its images, in use or not, as per-user.
  explicit ImagePool(pipeline::MemoryLedger& memory, std::size_t maxBytes = kUsualBytes);
  ~ImagePool();
  ImagePool(const ImagePool&) = delete;
  ImagePool& operator=(const ImagePool&) = delete;

  /// The contents are whatever was there before.
  [[nodiscard]] std::shared_ptr<Image> acquire(const world::Rect& rect);

  /// For when fewer will be wanted from now on.
  void freeUnused();

  [[nodiscard]] std::size_t unusedBytes() const;

 private:
  struct Store;
  std::shared_ptr<Store> store_;
};

}  // namespace grove::raster
