#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "stream/protocol/protocol.h"

namespace grove::cli {

/// Names of the codecs in options and reports.
inline const std::map<std::string, std::uint8_t> kCodecs{{"h264", stream::kCodecH264}, {"jpeg", stream::kCodecJpeg}};

[[nodiscard]] inline std::string codecName(std::uint8_t codec) {
  if (codec == stream::kCodecJpegPatches) codec = stream::kCodecJpeg;
  return std::ranges::find(kCodecs, codec, &std::pair<const std::string, std::uint8_t>::second)->first;
}

}  // namespace grove::cli
