#pragma once

#include <optional>

#include "world/camera.h"

namespace grove::raster {

/// Places rectangles in rows of an atlas. Works best in order of falling height.
class TilePacker {
 public:
  TilePacker(int width, int height) : width_(width), height_(height) {}

  /// Nothing if it does not fit.
  [[nodiscard]] std::optional<world::Rect> place(int width, int height);

  /// Bottom of the lowest rectangle.
  [[nodiscard]] int bottom() const noexcept { return rowTop_ + rowHeight_; }

 private:
  int width_;
  int height_;
  int rowTop_ = 0;
  int rowHeight_ = 0;
  int rowRight_ = 0;
};

}  // namespace grove::raster
