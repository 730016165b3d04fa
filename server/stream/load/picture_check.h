#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>

#include "stream/encode/h264_decoder.h"
#include "stream/protocol/protocol.h"

namespace grove::stream {

/// Looks whether the pictures that one visitor gets are what PROTOCOL.md says. To decode takes as long as to encode,
/// and would be measured with the server: of JPEG, one in thirty is decoded, of H.264 the whole chain, but the first
/// visitor's only; else, headers are read. One thread.
class PictureCheck {
 public:
  /// `decoder` may be shared by all of a thread.
  PictureCheck(int index, JpegDecoder& decoder) : index_(index), decoder_(decoder) {}

  /// What is wrong with the next picture, in a few words; nothing if it is all right.
  [[nodiscard]] std::optional<std::string> check(const PictureHeader& header, std::span<const std::uint8_t> picture);

  /// Whether the last picture could not be decoded, so that none that depends on it can: that is to be reported to the
  /// server once. Those that come nevertheless were under way; nothing is wrong with them.
  [[nodiscard]] bool takeBroken() { return std::exchange(reportBroken_, false); }

 private:
  [[nodiscard]] std::optional<std::string> checkJpeg(const PictureHeader& header,
                                                     std::span<const std::uint8_t> picture);
  [[nodiscard]] std::optional<std::string> checkH264(const PictureHeader& header,
                                                     std::span<const std::uint8_t> picture);
  [[nodiscard]] std::optional<std::string> breakChain(std::string reason);

  enum class Chain : std::uint8_t { kNone, kWhole, kBroken };

  const int index_;
  JpegDecoder& decoder_;
  std::optional<H264Decoder> h264_;  ///< of the first visitor, since his first such picture
  std::uint64_t jpegs_ = 0;
  Chain chain_ = Chain::kNone;  ///< of H.264 pictures, up to the last one
  std::pair<int, int> size_{0, 0};
  bool reportBroken_ = false;
};

}  // namespace grove::stream
