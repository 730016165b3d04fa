#include "stream/encode/jpeg/jpeg_decoder.h"

#include <turbojpeg.h>

#include "base/error.h"

namespace grove::stream {

JpegDecoder::JpegDecoder() { restart(); }

void JpegDecoder::restart() {
  handle_.reset(tjInitDecompress());
  if (!handle_) throw EnvironmentError(tjGetErrorStr2(nullptr), "JPEG decoder", "");
}

std::optional<std::pair<int, int>> JpegDecoder::size(std::span<const std::uint8_t> jpeg) {
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int colourSpace = 0;
  const int failed =
      tjDecompressHeader3(handle_.get(), jpeg.data(), jpeg.size(), &width, &height, &subsampling, &colourSpace);
  // The library accepts a truncated header as valid, without a picture, and then fails on the next picture.
  if (failed != 0 || width <= 0 || height <= 0) {
    restart();
    return std::nullopt;
  }
  return std::pair(width, height);
}

const DecodedPicture* JpegDecoder::decode(std::span<const std::uint8_t> jpeg) {
  const auto found = size(jpeg);
  if (!found) return nullptr;
  picture_.width = found->first;
  picture_.height = found->second;
  picture_.colour.resize(static_cast<std::size_t>(picture_.width) * static_cast<std::size_t>(picture_.height));
  const int failed =
      tjDecompress2(handle_.get(), jpeg.data(), jpeg.size(), reinterpret_cast<unsigned char*>(picture_.colour.data()),
                    picture_.width, 0, picture_.height, TJPF_RGBA, TJFLAG_STOPONWARNING);
  return failed == 0 ? &picture_ : nullptr;
}

}  // namespace grove::stream
