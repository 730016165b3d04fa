#pragma once

#include <optional>
#include <stop_token>
#include <string>

#include "cli/bench/encode/kept_frames.h"
#include "stream/encode/encoder_registry.h"

namespace grove::cli {

/// How a trial's pictures are led.
struct EncodeSetting {
  /// The same for all pictures; none: as for a visitor who asks for `kilobitsPerSecond`, of full size.
  std::optional<stream::Quantiser> quantiser;
  int kilobitsPerSecond = 0;
};

/// What encoding a walk's frames with one encoder took, and what it looks like.
struct EncodeTrial {
  std::string codec;
  EncodeSetting setting;
  std::size_t pictures = 0;      ///< that were sent: nothing is, where not a pixel has changed and nothing gets finer
  double quantiser = 0.0;        ///< mean of the pictures
  double cpuMilliseconds = 0.0;  ///< median of the pictures; of the thread
  double p99Milliseconds = 0.0;
  double kilobitsPerSecond = 0.0;
  double ssim = 0.0;  ///< mean of every tenth frame: luma of what a page shows against luma of what was drawn
  double minSsim = 0.0;
};

/// Encodes the frames as a visitor's session does, thirty a second, and decodes them again. Returns early, of the
/// frames by then, if it is to stop; there is one at least. Throws EnvironmentError if a library fails.
[[nodiscard]] EncodeTrial tryEncoder(const stream::EncoderRegistry& encoders, const stream::EncoderKind& kind,
                                     const EncodeSetting& setting, KeptFrames& frames, const std::stop_token& stop);

}  // namespace grove::cli
