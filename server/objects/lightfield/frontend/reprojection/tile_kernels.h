#pragma once

#include "objects/lightfield/common/cached_view.h"
#include "objects/lightfield/common/layered_haze.h"
#include "objects/lightfield/frontend/reprojection/reprojection_tile.h"

namespace grove::objects::lightfield {

/// The texels that a tile's rays can hit.
struct Reach {
  CachedView::Range range;         ///< nearnesses; greatest is 0 if there are none
  float texelsPerNearness = 1.0F;  ///< upper bound of a ray's movement in the picture per unit of nearness

  [[nodiscard]] bool shows() const noexcept { return range.max > 0.0F; }
};

/// Fills the tile whose first pixel is (left, top): finds the texels that its rays hit within `reach`, and sets
/// bilinear colour through haze, and depth. Returns false if no pixel is covered.
[[nodiscard]] bool warpTile(const CachedView& view, const ViewWarp& warp, const TileHaze& haze, const Reach& reach,
                            int left, int top, WarpTile& tile);

}  // namespace grove::objects::lightfield
