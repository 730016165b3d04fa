#pragma once

#include <cstdint>
#include <vector>

#include "objects/lightfield/format/light_field.h"
#include "objects/lightfield/simd/lens.h"
#include "world/camera.h"

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
  explicit WindowLayout(const TexelBox& box);
};

/// What a tile of pixels can see of a view's depth and colour. Reading it needs no look-up of blocks, and copying it
/// together reads memory in the order that it lies there.
class TexelWindow {
 public:
  void load(const LightField& field, int level, int view, int lighting, const TexelBox& box);

  [[nodiscard]] int stride() const noexcept { return layout_.stride; }
  [[nodiscard]] int origin() const noexcept { return layout_.origin; }
  [[nodiscard]] const std::uint16_t* depth() const noexcept { return depth_.data(); }
  [[nodiscard]] const std::uint32_t* colour() const noexcept { return colour_.data(); }

 private:
  WindowLayout layout_;
  std::vector<std::uint16_t> depth_;
  std::vector<std::uint32_t> colour_;
};

/// Nearness of a texel that shows nothing: no place on any ray.
inline constexpr float kNowhere = -1.0e6F;

/// What a tile of pixels can meet in a view, as 1 / view depth (per metre), kNowhere where nothing is.
class NearnessWindow {
 public:
  /// False if nothing in the box is covered.
  bool load(const LightField& field, int level, const Lens& lens, const TexelBox& box);

  [[nodiscard]] int stride() const noexcept { return layout_.stride; }
  [[nodiscard]] int origin() const noexcept { return layout_.origin; }
  [[nodiscard]] const float* nearness() const noexcept { return nearness_.data(); }
  /// View depths of what is covered, metres.
  [[nodiscard]] float nearest() const noexcept { return nearest_; }
  [[nodiscard]] float farthest() const noexcept { return farthest_; }

 private:
  WindowLayout layout_;
  float nearest_ = 0.0F;
  float farthest_ = 0.0F;
  std::vector<float> nearness_;
};

}  // namespace grove::objects::lightfield::simd
