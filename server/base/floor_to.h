#pragma once

namespace grove {

/// Rounds `value` down to a multiple of `step`. `step` must be positive.
[[nodiscard]] constexpr int floorTo(int value, int step) noexcept {
  const int rest = value % step;
  return value - (rest < 0 ? rest + step : rest);
}

}  // namespace grove
