#pragma once

namespace grove {

/// The largest multiple of `step`, which is positive, that is not greater than `value`.
[[nodiscard]] constexpr int floorTo(int value, int step) noexcept {
  const int rest = value % step;
  return value - (rest < 0 ? rest + step : rest);
}

}  // namespace grove
