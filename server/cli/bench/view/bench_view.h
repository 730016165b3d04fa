#pragma once

#include <optional>
#include <string>

#include "cli/bench/picture_size.h"

namespace grove::cli {

/// Each holds some 100 MB.
inline constexpr int kMaxStandingVisitors = 128;

/// `grove bench view`.
struct BenchViewOptions {
  std::optional<std::string> walk;  ///< file; default: around the fire
  std::optional<std::string> scene;
  PictureSize size{1280, 720};  ///< of the visitor's picture
  double seconds = 10.0;        ///< of the walk
  bool stand = false;           ///< where the walk begins, in a world that stands still
  int visitors = 1;             ///< who stand there
  bool json = false;
};

/// Draws what one visitor sees on a walk, at thirty frames a second, as fast as it goes, and beside one who draws
/// everything: the CPU of his own work, divided by type of object, the memory that a frame touches, and how his frames
/// differ from the others. A signal ends it early; what was measured by then is printed. Returns the process's exit
/// code. Of visitors who stand, measures what each costs instead. Throws world::WalkError, world::SceneError and
/// EnvironmentError.
int runBenchView(const BenchViewOptions& options);

}  // namespace grove::cli
