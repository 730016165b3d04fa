#pragma once

#include <optional>
#include <string>

#include "cli/bench/picture_size.h"

namespace grove::cli {

/// `grove bench encode`.
struct BenchEncodeOptions {
  std::optional<std::string> walk;  ///< file; default: around the fire
  PictureSize size{1280, 720};      ///< of each visitor's picture
  double seconds = 10.0;
  bool json = false;
};

/// Draws what a visitor sees on a walk through the grove, and where he stands before its fire, and encodes it in every
/// codec, at fixed quantisers and as led for visitors: CPU, bits and how alike the pictures are to what was drawn. A
/// signal ends it early; what was measured by then is printed. Returns the process's exit code: 0, or 2 with a line on
/// stderr if an option is out of range. Throws world::WalkError and EnvironmentError.
int runBenchEncode(const BenchEncodeOptions& options);

}  // namespace grove::cli
