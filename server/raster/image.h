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

/// A view of pixels owned elsewhere. A const plane gives const pixels.
template <class Pixel>
class Plane {
 public:
  Plane() = default;
  Plane(std::span<Pixel> pixels) noexcept : pixels_(pixels.data()), count_(pixels.size()) {}
  Plane(std::vector<Pixel>& pixels) noexcept : Plane(std::span(pixels)) {}
  // Not copyable: a copy of a const plane would give mutable pixels.
  Plane(const Plane&) = delete;
  Plane& operator=(const Plane&) = delete;
  Plane(Plane&&) noexcept = default;
  Plane& operator=(Plane&&) noexcept = default;
  ~Plane() = default;

  [[nodiscard]] Pixel* data() noexcept { return pixels_; }
  [[nodiscard]] const Pixel* data() const noexcept { return pixels_; }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
  [[nodiscard]] Pixel* begin() noexcept { return pixels_; }
  [[nodiscard]] Pixel* end() noexcept { return pixels_ + count_; }
  [[nodiscard]] const Pixel* begin() const noexcept { return pixels_; }
  [[nodiscard]] const Pixel* end() const noexcept { return pixels_ + count_; }
  [[nodiscard]] Pixel& operator[](std::size_t i) noexcept { return pixels_[i]; }
  [[nodiscard]] const Pixel& operator[](std::size_t i) const noexcept { return pixels_[i]; }
  [[nodiscard]] const Pixel& back() const noexcept { return pixels_[count_ - 1]; }

 private:
  Pixel* pixels_ = nullptr;
  std::size_t count_ = 0;
};

/// Colour and depth of a rectangle of a frame, rows from the top, in memory.
///
/// Colour is RGBA8 (bytes R, G, B, A), display-encoded and premultiplied by A = coverage. Depth is view depth in
/// metres, kInfiniteDepth if empty.
struct Image {
  world::Rect rect;
  Plane<std::uint32_t> colour;
  Plane<float> depth;
  bool opaque = false;  ///< guarantees that every pixel's A is 255, which makes compositing cheaper
  /// Per row, the columns that may be covered; other pixels are never read. Empty: whole rows.
  std::vector<Span> spans;

  [[nodiscard]] int width() const noexcept { return rect.width(); }
  [[nodiscard]] int height() const noexcept { return rect.height(); }
  [[nodiscard]] Span span(int row) const noexcept {
    return spans.empty() ? Span{0, width()} : spans[static_cast<std::size_t>(row)];
  }
  [[nodiscard]] std::uint32_t* colourRow(int row) noexcept { return colour.data() + std::ptrdiff_t{row} * width(); }
  [[nodiscard]] const std::uint32_t* colourRow(int row) const noexcept {
    return colour.data() + std::ptrdiff_t{row} * width();
  }
  [[nodiscard]] float* depthRow(int row) noexcept { return depth.data() + std::ptrdiff_t{row} * width(); }
  [[nodiscard]] const float* depthRow(int row) const noexcept { return depth.data() + std::ptrdiff_t{row} * width(); }
};

/// Lends images and reuses their memory after the last reference is dropped, so that frames neither allocate nor clear.
/// Keeps at most `maxBytes` of unused memory; frees the oldest first. Any thread; images may outlive the pool, and then
/// also the ledger.
class ImagePool {
 public:
  static constexpr std::size_t kUsualBytes = std::size_t{256} << 20U;

  explicit ImagePool(std::size_t maxBytes = kUsualBytes);
  /// Reports all memory of its images, used or unused, as per-user. Counts touched pages, starting with the first
  /// released image.
  explicit ImagePool(pipeline::MemoryLedger& memory, std::size_t maxBytes = kUsualBytes);
  ~ImagePool();
  ImagePool(const ImagePool&) = delete;
  ImagePool& operator=(const ImagePool&) = delete;

  /// The contents are undefined.
  [[nodiscard]] std::shared_ptr<Image> acquire(const world::Rect& rect);

  /// Memory for other kinds of pictures, held as long as `owner`.
  struct Bytes {
    std::span<std::uint8_t> bytes;
    std::shared_ptr<void> owner;
  };
  [[nodiscard]] Bytes acquireBytes(std::size_t size);

  /// Frees unused memory; for when demand falls.
  void freeUnused();

  [[nodiscard]] std::size_t unusedBytes() const;

 private:
  struct Store;
  struct Held;
  [[nodiscard]] std::shared_ptr<Held> hold(std::size_t pixels);
  std::shared_ptr<Store> store_;
};

}  // namespace grove::raster
