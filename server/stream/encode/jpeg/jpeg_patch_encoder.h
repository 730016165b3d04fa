#pragma once

#include "stream/encode/jpeg/jpeg_compressor.h"

namespace grove::stream {

/// Encodes pictures as JPEG, but while the camera rests only the parts that have changed: smoke and figures instead of
/// everything. For pages that cannot decode H.264, which browsers permit over https only.
class JpegPatchEncoder final : public Encoder {
 public:
  /// As JpegCompressor.
  explicit JpegPatchEncoder(int quality) : compressor_(quality) {}

  [[nodiscard]] std::uint8_t codec() const noexcept override;
  [[nodiscard]] QuantiserRange range() const noexcept override { return compressor_.range(); }
  bool encode(const raster::YuvImage& picture, const EncodeOrder& order, std::vector<std::uint8_t>& out) override;
  [[nodiscard]] std::size_t bytes() const noexcept override { return compressor_.bytes() + memory_.capacity(); }

 private:
  /// Returns false and appends nothing if most of the picture has changed, or nothing.
  [[nodiscard]] bool encodeChanges(const raster::YuvImage& picture, Quantiser quantiser,
                                   std::vector<std::uint8_t>& out);
  void append(const raster::YuvImage& picture, const world::Rect& part, Quantiser quantiser,
              std::vector<std::uint8_t>& out);
  void keep(const raster::YuvImage& picture);

  JpegCompressor compressor_;
  std::vector<std::uint8_t> memory_;
  raster::YuvImage kept_;      ///< what the page shows, before compression, in the memory; an empty rectangle: unknown
  Quantiser quantiser_ = 0.0;  ///< the coarsest of its parts
};

}  // namespace grove::stream
