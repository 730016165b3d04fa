#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "stream/encode/jpeg_decoder.h"

class ISVCDecoder;

namespace grove::stream {

/// Reads H.264 as PROTOCOL.md says: access units as Annex B byte streams, each of which needs those before it unless it
/// is independent. One a stream; one thread at a time.
class H264Decoder {
 public:
  /// Throws EnvironmentError if the library cannot start.
  H264Decoder();

  /// The picture of the next access unit, of BT.601 in its full range; null if it is damaged or needs one that was
  /// not decoded. The result stands until the next call.
  [[nodiscard]] const DecodedPicture* decode(std::span<const std::uint8_t> accessUnit);

 private:
  struct Deleter {
    void operator()(ISVCDecoder* decoder) const noexcept;
  };
  std::unique_ptr<ISVCDecoder, Deleter> decoder_;
  DecodedPicture picture_;
};

}  // namespace grove::stream
