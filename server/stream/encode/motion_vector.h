#pragma once

#include <cstdint>

namespace grove::stream {

/// From a block of a picture to the same content in the last encoded picture, in quarters of a pixel.
struct MotionVector {
  std::int16_t x = 0;
  std::int16_t y = 0;

  friend bool operator==(const MotionVector&, const MotionVector&) = default;
};

}  // namespace grove::stream
