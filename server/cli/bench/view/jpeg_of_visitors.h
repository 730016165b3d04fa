#pragma once

#include <memory>

#include "stream/encode/jpeg/jpeg_encoder.h"
#include "stream/session/host.h"

namespace grove::cli {

/// JPEG in the default quality of visitors.
[[nodiscard]] inline std::unique_ptr<stream::Encoder> jpegOfVisitors() {
  return std::make_unique<stream::JpegEncoder>(stream::HostOptions().jpegQuality);
}

}  // namespace grove::cli
