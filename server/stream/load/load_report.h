#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace grove::stream {

/// What one visitor of a load test saw.
struct VisitorStatistics {
  std::uint64_t frames = 0;
  std::uint64_t bytes = 0;
  std::uint64_t dropped = 0;               ///< gaps in the frames' numbers
  std::vector<float> latencyMilliseconds;  ///< one per input: from sending it to the first frame that shows it
  std::vector<std::string> errors;
};

/// The figures of `grove load`, of all visitors together.
struct LoadReport {
  int sessions = 0;  ///< that were let in
  double seconds = 0.0;
  std::uint64_t frames = 0;
  double fpsMin = 0.0;
  double fpsP50 = 0.0;
  double latencyP50Milliseconds = 0.0;
  double latencyP99Milliseconds = 0.0;
  double mbitPerSecond = 0.0;
  std::uint64_t dropped = 0;
  std::vector<std::string> errors;
};

/// The value that `share` (0 to 1) of the values do not exceed: nearest rank. 0 if there are none.
[[nodiscard]] double percentile(std::vector<float> values, double share);

/// `let in` are the statistics of those that were let in, during `seconds`; `errors` are of the others.
[[nodiscard]] LoadReport summarise(const std::vector<VisitorStatistics>& letIn, double seconds,
                                   std::vector<std::string> errors);

}  // namespace grove::stream
