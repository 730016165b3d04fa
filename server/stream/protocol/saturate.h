#pragma once

#include <algorithm>
#include <limits>

namespace grove::stream {

/// Clamps a value to the range of a message's field.
template <class Number>
[[nodiscard]] Number saturate(double value) {
  return static_cast<Number>(std::clamp(value, 0.0, static_cast<double>(std::numeric_limits<Number>::max())));
}

}  // namespace grove::stream
