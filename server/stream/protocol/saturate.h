#pragma once

#include <algorithm>
#include <limits>

namespace grove::stream {

/// The number nearest to a value that a field of a message holds.
template <class Number>
[[nodiscard]] Number saturate(double value) {
  return static_cast<Number>(std::clamp(value, 0.0, static_cast<double>(std::numeric_limits<Number>::max())));
}

}  // namespace grove::stream
