#include "stream/encode/jpeg/jpeg_encoder.h"

#include "stream/protocol/protocol.h"

namespace grove::stream {

std::uint8_t JpegEncoder::codec() const noexcept { return kCodecJpeg; }

bool JpegEncoder::encode(const raster::YuvImage& picture, const EncodeOrder& order, std::vector<std::uint8_t>& out) {
  compressor_.compress(picture, picture.rect, order.quantiser, out);
  return true;
}

}  // namespace grove::stream
