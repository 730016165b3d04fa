#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>

#include "stream/encode/h264_decoder.h"
#include "stream/protocol/protocol.h"

namespace grove::stream {

/// Checks that a visitor's pictures obey PROTOCOL.md. Decoding takes as long as encoding and would distort the
/// measurement of the server, so only one JPEG in thirty is decoded, and the whole H.264 chain of the first visitor
/// only; of other pictures, only headers are checked. Not thread-safe.
class PictureCheck {
 public:
  /// Checks of one thread may share `decoder`.
  PictureCheck(int index, JpegDecoder& decoder) : index_(index), decoder_(decoder) {}

  /// Checks the next picture. Returns a short error message, or nothing if the picture is valid.
  [[nodiscard]] std::optional<std::string> check(const PictureHeader& header, std::span<const std::uint8_t> picture);

  /// Returns whether the last picture could not be decoded, nor can any that depends on it; true once, to be reported
  /// to the server. Dependent pictures that still arrive were in flight and are not errors.
  [[nodiscard]] bool takeBroken() { return std::exchange(reportBroken_, false); }

 private:
  [[nodiscard]] std::optional<std::string> checkJpeg(const PictureHeader& header,
                                                     std::span<const std::uint8_t> picture);
  [[nodiscard]] std::optional<std::string> checkPatches(const PictureHeader& header,
                                                        std::span<const std::uint8_t> picture);
  /// Spreads the decoding over frames.
  [[nodiscard]] bool decodesNextJpeg();
  /// Returns what is wrong with the chain of a dependent picture of that size, if anything.
  [[nodiscard]] std::optional<std::string> faultOfChain(std::pair<int, int> size);
  [[nodiscard]] std::optional<std::string> checkH264(const PictureHeader& header,
                                                     std::span<const std::uint8_t> picture);
  [[nodiscard]] std::optional<std::string> breakChain(std::string reason);

  enum class Chain : std::uint8_t { kNone, kWhole, kBroken };

  const int index_;
  JpegDecoder& decoder_;
  std::optional<H264Decoder> h264_;  ///< of the first visitor, from the first such picture on
  std::uint64_t jpegs_ = 0;
  Chain chain_ = Chain::kNone;  ///< of pictures that depend on each other, up to the last one
  std::pair<int, int> size_{0, 0};
  bool reportBroken_ = false;
};

}  // namespace grove::stream
