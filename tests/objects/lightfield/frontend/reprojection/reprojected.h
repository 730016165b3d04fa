#pragma once

#include <algorithm>
#include <memory>

#include "objects/lightfield/common/view_cell.h"
#include "objects/lightfield/frontend/reprojection/reprojection.h"
#include "objects/lightfield/frontend/traced_picture.h"

namespace grove::objects::lightfield {

inline constexpr int kWidth = 640;
inline constexpr int kHeight = 360;
inline constexpr float kTestFocal = 310.0F;
inline constexpr float kError = 4.0F;

inline std::shared_ptr<raster::Image> reprojected(const CachedView& view, const ObjectCamera& camera,
                                                  const world::Rect& rect, const Haze& haze = {}) {
  auto image = raster::ImagePool().acquire(rect);
  std::ranges::fill(image->colour, 0U);
  std::ranges::fill(image->depth, world::kInfiniteDepth);
  const auto lay = [&](const world::Rect& part, const WarpTile& tile) {
    for (int row = 0; row < part.height(); ++row) {
      const int to = (part.top - rect.top + row) * rect.width() + part.left - rect.left;
      std::copy_n(tile.colour + row * kTileWidth, part.width(), image->colour.begin() + to);
      std::copy_n(tile.depth + row * kTileWidth, part.width(), image->depth.begin() + to);
    }
  };
  reproject(view, camera, haze, rect, lay, [](const world::Rect&, float) { return false; });
  return image;
}

/// A cell of a model and what it caches.
struct Cached {
  ViewCell cell;
  std::shared_ptr<raster::Image> picture;
  CachedView view;

  Cached(const TracedModel& model, world::Vec3 eye, float error, int samples = 3)
      : cell(viewCell(model.geometry(), eye, kTestFocal, error).value()),
        picture(model.picture(cell.camera, {0, 0, cell.size, cell.size}, samples)),
        view(*picture, cell.camera) {}

  /// How far the cell's eye can go before it leaves, a little less.
  [[nodiscard]] world::Vec3 towards(const TracedModel& model, world::Vec3 way, float error) const {
    float inside = 0.0F;
    float outside = 4.0F;
    for (int i = 0; i < 24; ++i) {
      const float middle = 0.5F * (inside + outside);
      const auto other = viewCell(model.geometry(), cell.camera.eye + middle * way, kTestFocal, error);
      (other && other->id == cell.id ? inside : outside) = middle;
    }
    return cell.camera.eye + 0.98F * inside * way;
  }
};

}  // namespace grove::objects::lightfield
