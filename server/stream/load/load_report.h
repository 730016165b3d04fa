#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "stream/protocol/protocol.h"

namespace grove::stream {

/// Kind of the picture on a visitor's screen.
struct ShownPicture {
  std::uint8_t codec = 0;
  int lines = 0;  ///< its height, pixels
  friend bool operator==(const ShownPicture&, const ShownPicture&) = default;
  friend bool operator<(const ShownPicture& a, const ShownPicture& b) {
    return std::tie(a.codec, a.lines) < std::tie(b.codec, b.lines);
  }
};

/// Measurements of one visitor of a load test.
struct VisitorStatistics {
  std::uint64_t frames = 0;
  std::uint64_t bytes = 0;
  std::uint64_t dropped = 0;               ///< gaps in the frames' numbers
  std::vector<float> latencyMilliseconds;  ///< one per input: from sending it to the first frame that shows it, or the
                                           ///< first Status that acknowledges it
  /// Longest time between two updates, including the measurement's begin and end: a picture, or a Status that
  /// acknowledges a new input, because no pictures are sent where nothing changes.
  double longestGapSeconds = 0.0;
  std::map<ShownPicture, std::uint64_t> shown;  ///< number of pictures of each kind
  std::map<LimitedBy, double> limitedSeconds;   ///< seconds during which the server named each limit
  std::optional<ShownPicture> screenAtFirst;    ///< the picture when the measurement began
  std::vector<std::string> errors;
};

/// Measurements of all visitors of a load test.
struct LoadOutcome {
  std::vector<VisitorStatistics> letIn;
  double seconds = 0.0;             ///< measured
  std::vector<std::string> errors;  ///< of visitors that were refused
};

/// The figures of `grove load`, over all visitors.
struct LoadReport {
  int sessions = 0;  ///< admitted
  double seconds = 0.0;
  std::uint64_t frames = 0;
  double fpsMin = 0.0;
  double fpsP50 = 0.0;
  double latencyP50Milliseconds = 0.0;
  double latencyP95Milliseconds = 0.0;
  double latencyP99Milliseconds = 0.0;
  double mbitPerSecond = 0.0;
  std::uint64_t dropped = 0;
  std::string codec = "jpeg";  ///< of most pictures: "jpeg" or "h264"
  int linesMin = 0;            ///< height of the pictures; of the first ones for visitors who got no others
  int linesP50 = 0;
  double longestGapMilliseconds = 0.0;       ///< maximum over visitors, see VisitorStatistics
  std::map<LimitedBy, double> limitedShare;  ///< share of all visitors' time during which the server named each limit
  std::vector<std::string> errors;
};

[[nodiscard]] LoadReport summarise(const LoadOutcome& outcome);

}  // namespace grove::stream
