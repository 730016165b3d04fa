#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "node/messages.h"
#include "stream/protocol.h"

namespace grove::stream {

/// A Frame message ready to send: `headroom` free bytes (the websocket library wants them), then header and picture.
struct EncodedFrame {
  static constexpr std::size_t kHeadroom = 32;
  FrameHeader header;
  std::vector<std::uint8_t> bytes;

  [[nodiscard]] std::span<const std::uint8_t> message() const { return std::span(bytes).subspan(kHeadroom); }
};

/// Makes a picture's bytes. One per session; one thread at a time.
class Encoder {
 public:
  virtual ~Encoder() = default;
  [[nodiscard]] virtual std::uint8_t codec() const noexcept = 0;
  /// Appends the encoded picture to `out`. Throws EnvironmentError if the library refuses.
  virtual void encode(const node::Image& image, std::vector<std::uint8_t>& out) = 0;
  /// Memory that it keeps from picture to picture.
  [[nodiscard]] virtual std::size_t bytes() const noexcept { return 0; }
};

}  // namespace grove::stream
