#pragma once

#include <array>
#include <optional>
#include <vector>

#include "stream/protocol/protocol.h"

namespace grove::stream {

/// Collects where a visitor's frames spend their time until the page receives them; medians of a second. Not
/// thread-safe.
class FrameTimes {
 public:
  enum class Place : std::uint8_t { kQueue, kDrawing, kEncoder, kSocket, kLine };

  void add(Place place, double seconds) { samples_[static_cast<std::size_t>(place)].push_back(seconds); }

  /// Returns the medians once a second, if a frame was encoded in it.
  [[nodiscard]] std::optional<Times> take(double now);

 private:
  [[nodiscard]] std::uint16_t takeMedian(Place place);

  std::array<std::vector<double>, 5> samples_;
  double taken_ = 0.0;
};

}  // namespace grove::stream
