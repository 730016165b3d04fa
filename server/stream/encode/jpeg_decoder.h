#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "stream/encode/jpeg_encoder.h"

namespace grove::stream {

/// A picture as `grove load` and tests see it.
struct DecodedPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> colour;  ///< bytes R, G, B, A; rows from the top
};

/// Reads what JpegEncoder writes. One thread at a time.
class JpegDecoder {
 public:
  JpegDecoder();

  /// Width and height from the header alone; nothing if it is no JPEG header.
  [[nodiscard]] std::optional<std::pair<int, int>> size(std::span<const std::uint8_t> jpeg);

  /// The whole picture; nothing if any part of it is damaged. The result stands until the next call.
  [[nodiscard]] const DecodedPicture* decode(std::span<const std::uint8_t> jpeg);

 private:
  void restart();

  TurboJpegHandle handle_;
  DecodedPicture picture_;
};

}  // namespace grove::stream
