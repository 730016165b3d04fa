#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "stream/encode/jpeg/jpeg_encoder.h"

namespace grove::stream {

/// A decoded picture, for `grove load` and tests.
struct DecodedPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> colour;  ///< bytes R, G, B, A; rows from the top
};

/// Decodes pictures of JpegEncoder. Not thread-safe.
class JpegDecoder {
 public:
  JpegDecoder();

  /// Returns width and height from the header; empty if it is no JPEG header.
  [[nodiscard]] std::optional<std::pair<int, int>> size(std::span<const std::uint8_t> jpeg);

  /// Returns the whole picture; null if any part of it is damaged. The result is valid until the next call.
  [[nodiscard]] const DecodedPicture* decode(std::span<const std::uint8_t> jpeg);

 private:
  void restart();

  TurboJpegHandle handle_;
  DecodedPicture picture_;
};

}  // namespace grove::stream
