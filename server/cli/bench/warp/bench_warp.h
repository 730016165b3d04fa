#pragma once

#include <optional>
#include <string>

#include "cli/bench/picture_size.h"

namespace grove::cli {

/// Options of `grove bench warp`.
struct BenchWarpOptions {
  std::optional<std::string> walk;  ///< file; default: around the fire
  PictureSize size{1280, 720};      ///< of the visitor's window
  double seconds = 10.0;
  double delay = 150.0;  ///< round trip of the line, milliseconds
  int pictures = 30;     ///< that the server sends a second: a divisor of 60
  int lines = 0;         ///< height of the server's pictures; 0: of the window
  std::string film;      ///< file to write; empty: none
  bool json = false;
};

/// Shows a walk as a page does over a slow line, on a display of 60 Hz: moves the newest picture, as it comes out of
/// the decoder, to where the visitor is by then, and compares it with the picture drawn there. Measures bits and CPU of
/// the depths that pages need for it. A signal ends it early; measurements until then are printed. Returns the
/// process's exit code. Throws world::WalkError and EnvironmentError.
int runBenchWarp(const BenchWarpOptions& options);

}  // namespace grove::cli
