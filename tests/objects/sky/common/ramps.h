#pragma once

#include <cstdint>

#include "objects/sky/common/panorama.h"

namespace grove::objects::sky {

/// Red tells the heading (up and down once around), green the row.
inline Panorama ramps() {
  Panorama panorama({256, 128});
  for (int row = 0; row < 128; ++row) {
    for (int column = 0; column < 256; ++column) {
      const auto red = static_cast<std::uint32_t>(column < 128 ? column * 2 : (255 - column) * 2);
      panorama.set(column, row, red | static_cast<std::uint32_t>(row * 2) << 8U | 0xFF000000U);
    }
  }
  return panorama;
}

}  // namespace grove::objects::sky
