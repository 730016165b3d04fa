#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace grove::measure {

/// Returns the smallest value that is at least as large as this share of all values; 0 without values.
template <class Number>
[[nodiscard]] double percentile(std::vector<Number> values, double share) {
  if (values.empty()) return 0.0;
  const double rank = std::ceil(share * static_cast<double>(values.size())) - 1.0;
  const auto index = static_cast<std::ptrdiff_t>(std::clamp(rank, 0.0, static_cast<double>(values.size() - 1)));
  std::ranges::nth_element(values, values.begin() + index);
  return static_cast<double>(values[static_cast<std::size_t>(index)]);
}

}  // namespace grove::measure
