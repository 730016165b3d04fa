#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace grove::cli {

/// Returns the median of at least one value; the upper of the two for an even number of values.
[[nodiscard]] inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Rounds to `digits` decimals.
[[nodiscard]] inline double rounded(double value, int digits) {
  const double scale = std::pow(10.0, digits);
  return std::round(value * scale) / scale;
}

}  // namespace grove::cli
