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

/// What kind of picture is on a visitor's screen.
struct ShownPicture {
  std::uint8_t codec = 0;
  int lines = 0;  ///< its height, pixels
  friend bool operator==(const ShownPicture&, const ShownPicture&) = default;
  friend bool operator<(const ShownPicture& a, const ShownPicture& b) {
    return std::tie(a.codec, a.lines) < std::tie(b.codec, b.lines);
  }
};

/// What one visitor of a load test saw.
struct VisitorStatistics {
  std::uint64_t frames = 0;
  std::uint64_t bytes = 0;
  std::uint64_t dropped = 0;               ///< gaps in the frames' numbers
  std::vector<float> latencyMilliseconds;  ///< one per input: from sending it to the first frame that shows it, or the
                                           ///< first Status that says that the screen obeys it
  /// Between two signs of life, the beginning and the end included: pictures, and whatever Status says that the screen
  /// obeys an input of which it was not known before, for where nothing changes no pictures are sent.
  double longestGapSeconds = 0.0;
  std::map<ShownPicture, std::uint64_t> shown;  ///< how many pictures of each kind came
  std::map<LimitedBy, double> limitedSeconds;   ///< for how long the server named each limit, seconds
  std::optional<ShownPicture> screenAtFirst;    ///< what was there when counting began
  std::vector<std::string> errors;
};

/// What the visitors of a load test saw.
struct LoadOutcome {
  std::vector<VisitorStatistics> letIn;
  double seconds = 0.0;             ///< that were counted
  std::vector<std::string> errors;  ///< of visitors that were not let in
};

/// The figures of `grove load`, of all visitors together.
struct LoadReport {
  int sessions = 0;  ///< that were let in
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
  int linesMin = 0;            ///< height of the pictures; of those that were there at first where no others came
  int linesP50 = 0;
  double longestGapMilliseconds = 0.0;       ///< of any visitor, see VisitorStatistics
  std::map<LimitedBy, double> limitedShare;  ///< of all visitors' time, that the server named each limit
  std::vector<std::string> errors;
};

[[nodiscard]] LoadReport summarise(const LoadOutcome& outcome);

}  // namespace grove::stream
