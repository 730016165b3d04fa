#pragma once

#include "objects/lightfield/common/cached_view.h"
#include "objects/lightfield/common/haze.h"
#include "objects/lightfield/frontend/reprojection/reprojection_tile.h"

namespace grove::objects::lightfield {

/// What the rays of a tile can meet.
struct Reach {
  CachedView::Range range;         ///< nearnesses; greatest is 0 if there are none
  float texelsPerNearness = 1.0F;  ///< how far a ray moves in the picture for one unit of nearness, at most

  [[nodiscard]] bool shows() const noexcept { return range.max > 0.0F; }
};

/// Fills the tile whose first pixel is (left, top): finds what its rays meet within `reach`, and sets bilinear colour
/// through the haze, and depth. False if nothing shows.
[[nodiscard]] bool warpTile(const CachedView& view, const ViewWarp& warp, const Haze& haze, const Reach& reach,
                            int left, int top, WarpTile& tile);

}  // namespace grove::objects::lightfield
