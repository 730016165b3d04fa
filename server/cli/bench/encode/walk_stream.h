#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "node/messages.h"
#include "raster/yuv_image.h"
#include "stream/adapt/stream_control.h"
#include "stream/encode/encoder_registry.h"
#include "stream/encode/h264_decoder.h"
#include "stream/encode/jpeg/jpeg_decoder.h"
#include "stream/encode/jpeg/jpeg_patch_decoder.h"
#include "stream/encode/scene_motion.h"

namespace grove::cli {

/// Rate control of a bench's stream.
struct EncodeSetting {
  /// Fixed for all pictures; none: rate control for a visitor with a limit of `kilobitsPerSecond`, in full size.
  std::optional<stream::Quantiser> quantiser;
  int kilobitsPerSecond = 0;
  double framesPerSecond = 30.0;
};

struct SentPicture {
  std::span<const std::uint8_t> bytes;
  bool independent = false;
};

/// Encodes the frames of a walk as stream::EncodeStage does for a visitor, and measures its time. The
/// registry outlives it. Not thread-safe.
class WalkEncoder {
 public:
  WalkEncoder(const stream::EncoderRegistry& encoders, const stream::EncoderKind& kind, const EncodeSetting& setting,
              int width, int height);

  /// Returns the picture to send to a page that shows all previous ones, valid until the next call; nothing if the page
  /// needs none. Throws EnvironmentError if a library fails.
  [[nodiscard]] std::optional<SentPicture> send(const node::FinishedFrame& frame);

  /// CPU of the thread for each sent picture, milliseconds.
  [[nodiscard]] const std::vector<double>& times() const noexcept { return times_; }
  /// Mean of the sent pictures.
  [[nodiscard]] double quantiser() const noexcept { return quantisers_ / static_cast<double>(times_.size()); }
  [[nodiscard]] double kilobitsPerSecond() const noexcept;

 private:
  const stream::EncoderKind& kind_;
  const EncodeSetting setting_;
  stream::StreamControl control_;
  const std::unique_ptr<stream::Encoder> encoder_;
  int frames_ = 0;
  std::optional<world::Camera> camera_;
  stream::SceneMotion motion_;
  std::uint64_t hash_ = 0;
  stream::Quantiser quantiser_ = 0.0;
  std::vector<std::uint8_t> bytes_;
  std::size_t sent_ = 0;
  std::vector<double> times_;
  double quantisers_ = 0.0;
};

/// Decodes a stream as a page does. Not thread-safe.
class WalkDecoder {
 public:
  explicit WalkDecoder(std::uint8_t codec) : codec_(codec) {}

  /// Throws EnvironmentError if the picture cannot be decoded.
  void show(const SentPicture& picture);
  /// The picture that is shown. Call show() first.
  [[nodiscard]] const stream::DecodedPicture& shown() const { return *shown_; }

 private:
  [[nodiscard]] const stream::DecodedPicture* decode(const SentPicture& picture);

  const std::uint8_t codec_;
  stream::JpegDecoder jpeg_;
  stream::JpegPatchDecoder patches_;
  stream::H264Decoder h264_;
  const stream::DecodedPicture* shown_ = nullptr;
};

}  // namespace grove::cli
