#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "measure/pictures/picture_quality.h"

namespace grove::tests {

/// A picture of plain grass, for tests that change single pixels.
struct GrassFilm {
  static constexpr int kWidth = 40;
  static constexpr int kHeight = 30;
  static constexpr std::uint32_t kGrass = 0xFF206040U;

  std::vector<std::uint32_t> colour = std::vector<std::uint32_t>(std::size_t{kWidth} * kHeight, kGrass);

  void set(int x, int y, std::uint32_t value) {
    colour[static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x)] = value;
  }
  [[nodiscard]] measure::Picture picture() const { return {colour, kWidth}; }
};

}  // namespace grove::tests
