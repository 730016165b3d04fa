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

/// How a part of a view is laid out densely: whole blocks across, rows as needed. The texel (column, row) of the view
/// is at row * stride + column - origin.
struct WindowLayout {
  int stride = 0;
  int origin = 0;
  std::size_t texels = 0;

  WindowLayout() = default;
  explicit WindowLayout(const TexelBox& box)
      : stride((box.right / kBlock - box.left / kBlock + 1) * kBlock),
        origin(box.top * stride + box.left / kBlock * kBlock),
        // One more, for they are read in pairs.
        texels(static_cast<std::size_t>(stride * (box.bottom - box.top + 1) + 1)) {}
};

/// What a tile of pixels can see of a view's depth and colour. Reading it needs no look-up of blocks, and copying it
/// together reads memory in the order that it lies there.
struct TexelWindow {
  WindowLayout layout;
  std::vector<std::uint16_t> depth;
  std::vector<std::uint32_t> colour;
};

/// Nearness of a texel that shows nothing: no place on any ray.
inline constexpr float kNowhere = -1.0e6F;

/// What a tile of pixels can meet in a view, as 1 / view depth (per metre), kNowhere where nothing is.
struct NearnessWindow {
  WindowLayout layout;
  float nearest = 0.0F;  ///< view depths of what is covered, metres
  float farthest = 0.0F;
  std::vector<float> nearness;
};

}  // namespace grove::objects::lightfield::simd
