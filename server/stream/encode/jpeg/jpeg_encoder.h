#pragma once

#include "stream/encode/jpeg/jpeg_compressor.h"

namespace grove::stream {

/// Encodes each picture as one JPEG. No frame depends on another, so any may be dropped.
class JpegEncoder final : public Encoder {
 public:
  /// As JpegCompressor.
  explicit JpegEncoder(int quality) : compressor_(quality) {}

  [[nodiscard]] std::uint8_t codec() const noexcept override;
  [[nodiscard]] QuantiserRange range() const noexcept override { return compressor_.range(); }
  bool encode(const raster::YuvImage& picture, const EncodeOrder& order, std::vector<std::uint8_t>& out) override;
  [[nodiscard]] std::size_t bytes() const noexcept override { return compressor_.bytes(); }

 private:
  JpegCompressor compressor_;
};

}  // namespace grove::stream
