#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/bench/picture_size.h"

namespace grove::cli {

/// Options of `grove bench encode`.
struct BenchEncodeOptions {
  std::optional<std::string> walk;  ///< file; default: around the fire
  PictureSize size{1280, 720};      ///< of each visitor's picture
  double seconds = 10.0;
  std::optional<std::filesystem::path> keep;  ///< folder for frames and streams of the walk at fixed quantisers
  bool json = false;
};

/// Draws what a visitor sees on a walk through the grove, and in front of its fire, and encodes it with every codec, at
/// fixed quantisers and with the rate control of visitors. Measures CPU, bits and the similarity of the pictures to the
/// drawn ones. With a folder to keep them, measures the walk at fixed quantisers only, and writes its frames
/// (frames.y4m) and streams (ENCODER-QUANTISER.h264) for other programs. A signal ends it early; measurements until
/// then are printed, and incomplete files are removed. Returns the process's exit code: 0, or 2 with a line on stderr
/// if an option is out of range. Throws world::WalkError and EnvironmentError.
int runBenchEncode(const BenchEncodeOptions& options);

}  // namespace grove::cli
