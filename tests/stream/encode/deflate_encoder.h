#pragma once

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "stream/encode/encoder_registry.h"

/// The smallest real encoder: planes of Y, U and V as differences between neighbours, compressed by zlib. It makes far
/// more bytes than JPEG. Shows what an encoder of one's own needs.
namespace grove::stream {

/// The first number that PROTOCOL.md has left.
inline constexpr std::uint8_t kCodecDeflate = 3;

class DeflateEncoder final : public Encoder {
 public:
  [[nodiscard]] std::uint8_t codec() const noexcept override { return kCodecDeflate; }
  [[nodiscard]] QuantiserRange range() const noexcept override {
    return {.finest = kLossless, .usual = kLossless + 6.0, .coarsest = kLossless + 24.0};
  }

  bool encode(const raster::YuvImage& picture, const EncodeOrder& order, std::vector<std::uint8_t>& out) override {
    const int bits = bitsToDrop(order.quantiser);
    differences_.assign(picture.bytes.begin(), picture.bytes.end());
    std::uint8_t last = 0;
    for (std::uint8_t& sample : differences_) {
      const auto kept = static_cast<std::uint8_t>(sample >> bits << bits);
      sample = static_cast<std::uint8_t>(kept - last);
      last = kept;
    }
    const std::size_t before = out.size();
    uLongf size = compressBound(differences_.size());
    out.resize(before + size);
    if (compress2(out.data() + before, &size, differences_.data(), differences_.size(), Z_BEST_SPEED) != Z_OK) {
      throw EnvironmentError("cannot compress a picture", "zlib", "offer JPEG only");
    }
    out.resize(before + size);
    return true;
  }

  [[nodiscard]] std::size_t bytes() const noexcept override { return differences_.capacity(); }

 private:
  static constexpr Quantiser kLossless = 4.0;

  /// H.264's step doubles every six quantisers, as the step of samples does with each bit.
  static int bitsToDrop(Quantiser quantiser) {
    return std::clamp(static_cast<int>(std::lround((quantiser - kLossless) / 6.0)), 0, 4);
  }

  std::vector<std::uint8_t> differences_;
};

/// Registers it beside the built-in encoders. Pages that do not offer the codec get what they got before.
inline EncoderRegistry encodersWithDeflate() {
  EncoderRegistry registry = builtinEncoders(75);
  registry.add({.codec = kCodecDeflate,
                .chained = false,
                .name = "deflate",
                .library = std::string("zlib ") + zlibVersion(),
                .make = [] { return std::make_unique<DeflateEncoder>(); }});
  return registry;
}

}  // namespace grove::stream
