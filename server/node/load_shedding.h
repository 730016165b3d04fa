#pragma once

#include <algorithm>

namespace grove::node {

/// Load shedding: the factor for the permitted errors of pictures at this share of busy workers, so that visitors of a
/// machine at its limit lose accuracy before they lose frames. From 1 (up to 75 % busy) to kMaxErrorFactor (from 95 %).
inline constexpr float kMaxErrorFactor = 4.0F;

[[nodiscard]] inline float errorFactor(double busyShare) {
  constexpr double kBegins = 0.75;
  constexpr double kEnds = 0.95;
  const double shed = std::clamp((busyShare - kBegins) / (kEnds - kBegins), 0.0, 1.0);
  return 1.0F + (kMaxErrorFactor - 1.0F) * static_cast<float>(shed);
}

}  // namespace grove::node
