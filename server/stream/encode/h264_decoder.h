#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "stream/encode/jpeg/jpeg_decoder.h"

class ISVCDecoder;

namespace grove::stream {

/// Decodes H.264 as in PROTOCOL.md: access units as Annex B byte streams, each of which needs the earlier ones unless
/// it is independent. One per stream. Not thread-safe.
class H264Decoder {
 public:
  /// Throws EnvironmentError if the library cannot start.
  H264Decoder();

  /// Returns the picture of the next access unit, BT.601 full range; null if it is damaged or needs one that was not
  /// decoded. The result is valid until the next call.
  [[nodiscard]] const DecodedPicture* decode(std::span<const std::uint8_t> accessUnit);

 private:
  struct Deleter {
    void operator()(ISVCDecoder* decoder) const noexcept;
  };
  std::unique_ptr<ISVCDecoder, Deleter> decoder_;
  DecodedPicture picture_;
};

}  // namespace grove::stream
