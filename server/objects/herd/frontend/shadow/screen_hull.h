#pragma once

#include <span>
#include <vector>

#include "raster/image.h"
#include "world/camera.h"

namespace grove::objects::herd {

/// The pixels of a frame that a convex body may cover.
class ScreenHull {
 public:
  static constexpr std::size_t kMostCorners = 16;

  /// `corners` of the body, at most kMostCorners, in the world. Of a body that reaches behind the near plane, the part
  /// beyond it counts.
  ScreenHull(std::span<const world::Vec3> corners, const world::Camera& camera, const world::Rect& within);

  /// Empty if the body is out of sight.
  [[nodiscard]] const world::Rect& rect() const noexcept { return rect_; }
  /// The columns of a row of rect(), in pixels of the frame.
  [[nodiscard]] raster::Span row(int y) const noexcept { return rows_[static_cast<std::size_t>(y - rect_.top)]; }

 private:
  /// Adds the edges of one side of the hull; `side`: 1 or -1. `downwards`: all points, in that order.
  void addSide(std::span<const world::Vec2> downwards, float side);
  /// `b` is not above `a`.
  void addEdge(world::Vec2 a, world::Vec2 b);

  world::Rect rect_;
  std::vector<raster::Span> rows_;
};

}  // namespace grove::objects::herd
