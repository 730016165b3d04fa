#pragma once

#include <string>

namespace grove::cli {

/// What `grove --version` prints, one fact a line: the version, the SIMD target in use and the others that this
/// processor has, what GL draws with (or why there is none), the codecs. Makes a GL context for it.
[[nodiscard]] std::string versionReport();

}  // namespace grove::cli
