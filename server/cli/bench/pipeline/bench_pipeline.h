#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/bench/picture_size.h"
#include "node/transport/transport_kind.h"

namespace grove::cli {

/// Options of `grove bench pipeline`.
struct BenchPipelineOptions {
  std::vector<int> framesInFlight = {1, 4};  ///< each 1 to node::kMaxFramesInFlight, each once
  int users = 1;
  double seconds = 5.0;              ///< measured for each number of frames in flight, after a warm-up
  std::optional<std::string> scene;  ///< file; default: the grove
  PictureSize size{1280, 720};       ///< of each visitor's picture
  node::TransportKind transport = node::TransportKind::kReference;
  bool json = false;
  std::optional<std::string> trace;  ///< file to write the measured runs to
};

/// Serves visitors who walk in circles, without sockets and as fast as the machine can, and prints each visitor's frame
/// rate and the utilisation of every stage, for each number of frames in flight: Figures 4.3 and 4.4 of the paper. A
/// signal ends it early; measurements until then are printed. Returns the process's exit code: 0, or 2 with a line on
/// stderr if an option is out of range. Throws world::SceneError and EnvironmentError.
int runBenchPipeline(const BenchPipelineOptions& options);

}  // namespace grove::cli
