#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "stream/protocol/protocol.h"

namespace grove::stream {

/// A Frame or Picture message ready to send: `headroom` free bytes, which the websocket library needs, then header and
/// picture.
struct EncodedFrame {
  static constexpr std::size_t kHeadroom = 32;
  PictureHeader header;
  double allowedBytes = 0.0;  ///< available to the picture
  std::vector<std::uint8_t> bytes;

  [[nodiscard]] std::span<const std::uint8_t> message() const { return std::span(bytes).subspan(kHeadroom); }
};

}  // namespace grove::stream
