#pragma once

#include <string>

namespace grove::cli {

/// Returns the output of `grove --version`, one fact per line: the version, the SIMD target in use and the processor's
/// others, the GL renderer (or why there is none), the codecs. Makes a GL context for it.
[[nodiscard]] std::string versionReport();

}  // namespace grove::cli
