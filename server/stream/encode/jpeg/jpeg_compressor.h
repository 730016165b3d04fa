#pragma once

#include <memory>

#include "stream/encode/encoder.h"

namespace grove::stream {

/// Frees a handle of the TurboJPEG library.
struct TurboJpegDeleter {
  void operator()(void* handle) const noexcept;
};
using TurboJpegHandle = std::unique_ptr<void, TurboJpegDeleter>;

/// Compresses parts of pictures as baseline JPEG, 4:2:0, by libjpeg-turbo. About 3 ms of CPU for 1280 x 720 pixels. Its
/// scratch buffer holds the worst case of the largest part so far. Not thread-safe.
class JpegCompressor {
 public:
  /// `quality`, 1 to 100, applies to moving pictures; still ones get better. Throws EnvironmentError if the library
  /// cannot start.
  explicit JpegCompressor(int quality);

  [[nodiscard]] QuantiserRange range() const noexcept;
  /// Appends a part of a picture, whose edges are even, to `out`. Throws EnvironmentError if the library fails.
  void compress(const raster::YuvImage& picture, const world::Rect& part, Quantiser quantiser,
                std::vector<std::uint8_t>& out);
  /// Bytes of the scratch buffer that the largest part so far used; the rest was never touched.
  [[nodiscard]] std::size_t bytes() const noexcept { return touchedBytes_; }

 private:
  const int quality_;
  TurboJpegHandle handle_;
  std::unique_ptr<unsigned char[]> scratch_;
  unsigned long scratchBytes_ = 0;
  unsigned long touchedBytes_ = 0;
};

}  // namespace grove::stream
