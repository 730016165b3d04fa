#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <string>

#include "cli/bench/encode/kept_frames.h"
#include "cli/bench/encode/walk_stream.h"

namespace grove::cli {

/// Cost and quality of encoding a walk's frames with one encoder.
struct EncodeTrial {
  std::string codec;
  std::string encoder;  ///< name of its kind
  EncodeSetting setting;
  std::size_t pictures = 0;      ///< sent pictures; none is sent where no pixel has changed and no refinement is due
  double quantiser = 0.0;        ///< mean of the pictures
  double cpuMilliseconds = 0.0;  ///< of the thread, median of the pictures
  double meanMilliseconds = 0.0;
  double p99Milliseconds = 0.0;
  double kilobitsPerSecond = 0.0;
  double ssim = 0.0;  ///< mean over every tenth frame: luma of the page's picture against luma of the drawn one
  double minSsim = 0.0;
};

/// Encodes the frames as a visitor's session does, 30 per second, and decodes them again. After a stop request, returns
/// the results so far, of at least one frame. Calls `keep` with each sent picture. Throws EnvironmentError if a library
/// fails.
[[nodiscard]] EncodeTrial tryEncoder(const stream::EncoderRegistry& encoders, const stream::EncoderKind& kind,
                                     const EncodeSetting& setting, KeptFrames& frames, const std::stop_token& stop,
                                     const std::function<void(std::span<const std::uint8_t>)>& keep = {});

}  // namespace grove::cli
