#pragma once

#include <cstddef>
#include <cstdint>

#include "world/camera.h"

namespace grove::objects::lightfield {

/// Depth of empty pixels, metres.
inline constexpr float kRelightFarthest = 1.0e4F;

/// A part of a raster::Image, rows `stride` pixels apart; `rect` is in pixels of `camera`.
struct PicturePart {
  std::uint32_t* colour = nullptr;
  const float* depth = nullptr;
  std::ptrdiff_t stride = 0;
  world::Rect rect;
};

}  // namespace grove::objects::lightfield
