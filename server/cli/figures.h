#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace grove::cli {

/// Of at least one value; of an even number the upper of the two in the middle.
[[nodiscard]] inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// To so many digits after the point.
[[nodiscard]] inline double rounded(double value, int digits) {
  const double scale = std::pow(10.0, digits);
  return std::round(value * scale) / scale;
}

}  // namespace grove::cli
