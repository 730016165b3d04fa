#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "objects/lightfield/format/light_field.h"

namespace grove::objects::lightfield::simd {

/// A rectangle of texels, both ends inclusive.
struct TexelBox {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
};

/// Dense layout of a part of a view: whole blocks across, as many rows as needed. The view's texel (column, row) is at
/// row * stride + column - origin.
struct WindowLayout {
  int stride = 0;
  int origin = 0;
  std::size_t texels = 0;

  WindowLayout() = default;
  explicit WindowLayout(const TexelBox& box)
      : stride((box.right / kBlock - box.left / kBlock + 1) * kBlock),
        origin(box.top * stride + box.left / kBlock * kBlock),
        // One more, because texels are read in pairs.
        texels(static_cast<std::size_t>(stride * (box.bottom - box.top + 1) + 1)) {}
};

/// A view's depth and colour within the reach of a tile of pixels. Reading it needs no look-up of blocks, and filling
/// it reads memory in order.
struct TexelWindow {
  WindowLayout layout;
  std::vector<std::uint16_t> depth;
  std::vector<std::uint32_t> colour;
};

/// Nearness of an empty texel: no place on any ray.
inline constexpr float kNowhere = -1.0e6F;

/// The depths that a tile of pixels can hit in a view, as 1 / view depth (per metre), kNowhere if empty.
struct NearnessWindow {
  WindowLayout layout;
  float nearest = 0.0F;  ///< view depths of the covered texels, metres
  float farthest = 0.0F;
  std::vector<float> nearness;
};

}  // namespace grove::objects::lightfield::simd
