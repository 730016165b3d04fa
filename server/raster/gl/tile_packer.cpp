#include "raster/gl/tile_packer.h"

#include <algorithm>

namespace grove::raster {

std::optional<world::Rect> TilePacker::place(int width, int height) {
  if (width > width_) return std::nullopt;
  const bool newRow = rowRight_ + width > width_;
  const int top = newRow ? rowTop_ + rowHeight_ : rowTop_;
  if (top + height > height_) return std::nullopt;
  if (newRow) {
    rowTop_ = top;
    rowHeight_ = 0;
    rowRight_ = 0;
  }
  const world::Rect rect{rowRight_, rowTop_, rowRight_ + width, rowTop_ + height};
  rowRight_ = rect.right;
  rowHeight_ = std::max(rowHeight_, height);
  return rect;
}

}  // namespace grove::raster
