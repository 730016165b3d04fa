#pragma once

#include "stream/encode/jpeg/jpeg_decoder.h"

namespace grove::stream {

/// Decodes pictures of JpegPatchEncoder, for `grove bench` and tests. Not thread-safe.
class JpegPatchDecoder {
 public:
  /// Returns the whole picture; null if any part of it is damaged or outside of it, or if it depends on an earlier one
  /// and there is none. The result is valid until the next call.
  [[nodiscard]] const DecodedPicture* decode(std::span<const std::uint8_t> picture, bool independent);

 private:
  [[nodiscard]] bool draw(const DecodedPicture& part, int left, int top);

  JpegDecoder jpeg_;
  DecodedPicture picture_;
};

}  // namespace grove::stream
