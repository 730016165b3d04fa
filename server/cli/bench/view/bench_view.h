#pragma once

#include <optional>
#include <string>

#include "cli/bench/picture_size.h"

namespace grove::cli {

/// `grove bench view`.
struct BenchViewOptions {
  std::optional<std::string> walk;  ///< file; default: around the fire
  std::optional<std::string> scene;
  PictureSize size{1280, 720};  ///< of the visitor's picture
  double seconds = 10.0;        ///< of the walk
  bool json = false;
};

/// Draws what one visitor sees on a walk, at thirty frames a second, as fast as it goes, and beside one who draws
/// everything: the CPU of his own work, divided by type of object, the memory that a frame touches, and how his frames
/// differ from the others. A signal ends it early; what was measured by then is printed. Returns the process's exit
/// code. Throws world::WalkError, world::SceneError and EnvironmentError.
int runBenchView(const BenchViewOptions& options);

}  // namespace grove::cli
