#pragma once

#include <optional>
#include <string>

#include "cli/bench/picture_size.h"
#include "cli/bench/view/exact_quality.h"

namespace grove::cli {

/// Each visitor takes some 100 MB.
inline constexpr int kMaxStandingVisitors = 128;

/// Options of `grove bench view`.
struct BenchViewOptions {
  std::optional<std::string> walk;  ///< file; default: around the fire
  std::optional<std::string> scene;
  PictureSize size{1280, 720};  ///< of the visitor's picture
  double seconds = 10.0;        ///< of the walk
  bool stand = false;           ///< measure standing visitors where the walk begins, in a world at rest
  int visitors = 1;             ///< number of standing visitors
  bool exact = false;           ///< compare what a busy server shows with exact pictures
  Shed shed;                    ///< with `exact`
  bool json = false;
};

/// Draws what one visitor sees on a walk, at 30 frames per second, as fast as possible, and together with a reference
/// visitor for whom everything is drawn. Measures the CPU of the visitor's own work by type of object, the memory that
/// a frame touches, and the differences from the reference. With `stand`, measures the cost of each standing visitor
/// instead; with `exact`, the differences from exact pictures. A signal ends it early; measurements until then are
/// printed. Returns the process's exit code. Throws world::WalkError, world::SceneError and EnvironmentError.
int runBenchView(const BenchViewOptions& options);

}  // namespace grove::cli
