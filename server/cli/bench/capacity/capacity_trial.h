#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "cli/bench/picture_size.h"
#include "stream/load/load_report.h"

namespace grove::cli {

/// What all trials of a capacity search have in common.
struct CapacityPlan {
  std::optional<std::string> scene;
  std::uint8_t codec = stream::kCodecJpeg;
  PictureSize size{1280, 720};             ///< of each visitor's picture
  double seconds = 10.0;                   ///< measured
  double warmUp = 6.0;                     ///< seconds from the last visitor's entry to the first frame that counts
  std::string program = "/proc/self/exe";  ///< `grove`
};

/// What one trial has measured.
struct CapacityTrial {
  int visitors = 0;
  bool privateWorlds = false;  ///< one server per visitor
  stream::LoadReport load;
  double cpuCores = 0.0;   ///< of all servers
  std::int64_t bytes = 0;  ///< of all servers; a shared page counts once

  /// Returns whether every visitor got 30 frames per second at a latency of 100 ms (design: capacity), in pictures of
  /// full size, without refused visitors.
  [[nodiscard]] bool isServed(const PictureSize& size) const;
  /// CPU of the servers per frame and visitor.
  [[nodiscard]] double cpuMillisecondsPerFrame() const;
};

/// Starts one server, or one per visitor, and lets `visitors` stroll; they enter one after another. Visitors are
/// websocket clients in this process. Returns nothing if it was stopped. Throws EnvironmentError.
[[nodiscard]] std::optional<CapacityTrial> runCapacityTrial(const CapacityPlan& plan, int visitors, bool privateWorlds,
                                                            const std::stop_token& stop);

}  // namespace grove::cli
