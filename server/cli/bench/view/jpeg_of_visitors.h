#pragma once

#include <memory>

#include "stream/encode/jpeg_encoder.h"
#include "stream/session/host.h"

namespace grove::cli {

/// JPEG in the quality that visitors get if nobody asks for another.
[[nodiscard]] inline std::unique_ptr<stream::Encoder> jpegOfVisitors() {
  return std::make_unique<stream::JpegEncoder>(stream::HostOptions().jpegQuality);
}

}  // namespace grove::cli
