#pragma once

#include <memory>

#include "stream/encode/encoder.h"

namespace grove::stream {

/// Frees a handle of the TurboJPEG library.
struct TurboJpegDeleter {
  void operator()(void* handle) const noexcept;
};
using TurboJpegHandle = std::unique_ptr<void, TurboJpegDeleter>;

/// Baseline JPEG, 4:2:0, by libjpeg-turbo. No frame depends on another, so any may be dropped. About 3 ms of CPU for
/// 1280 x 720 pixels. Its scratch buffer holds the worst case of the largest picture so far.
class JpegEncoder final : public Encoder {
 public:
  /// `quality`, 1 to 100, applies to moving pictures; still ones get better. Throws EnvironmentError if the library
  /// cannot start.
  explicit JpegEncoder(int quality);

  [[nodiscard]] std::uint8_t codec() const noexcept override;
  [[nodiscard]] QuantiserRange range() const noexcept override;
  bool encode(const raster::YuvImage& picture, const EncodeOrder& order, std::vector<std::uint8_t>& out) override;
  /// Bytes of the scratch buffer that the largest picture so far used; the rest was never touched.
  [[nodiscard]] std::size_t bytes() const noexcept override { return touchedBytes_; }

 private:
  const int quality_;
  TurboJpegHandle handle_;
  std::unique_ptr<unsigned char[]> scratch_;
  unsigned long scratchBytes_ = 0;
  unsigned long touchedBytes_ = 0;
};

}  // namespace grove::stream
