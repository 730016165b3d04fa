#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/bench/amortize/course.h"
#include "cli/bench/picture_size.h"
#include "node/transport/transport_kind.h"
#include "stream/protocol/protocol.h"

namespace grove::cli {

/// `grove bench amortize`.
struct BenchAmortizeOptions {
  std::vector<int> users;  ///< numbers of visitors; empty: 1, 2, 4 and 8, and the paper's figure
  double seconds = 5.0;    ///< to measure each
  int frames = 0;          ///< of each visitor to measure instead, unless 0
  bool figure = false;     ///< the paper's Figure 5.6
  std::vector<Course> courses{Course::kTogether};        ///< rows of each; fits are of the first
  std::vector<std::uint8_t> codecs{stream::kCodecJpeg};  ///< rows of each; fits are of the first
  std::optional<std::string> scene;
  PictureSize size{1280, 720};  ///< of each visitor's picture
  node::TransportKind transport = node::TransportKind::kReference;
  bool json = false;
  std::optional<std::string> plot;  ///< SVG file to write
};

/// Most visitors that can be asked for.
inline constexpr int kMaxAmortizeUsers = 1024;

/// Serves visitors that share a world and visitors who have one each, and prints what sharing saves. Returns the
/// process's exit code: 0, also if a signal ended it early, or 2 with a line on stderr for bad options or if the
/// visitors do not fit into memory. The process must have no other threads. Throws EnvironmentError, world::SceneError
/// or as measureRow().
int runBenchAmortize(const BenchAmortizeOptions& options);

}  // namespace grove::cli
