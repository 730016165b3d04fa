#pragma once

#include "objects/lightfield/common/cached_view.h"
#include "objects/lightfield/frontend/reprojection/reprojection_tile.h"

namespace grove::objects::lightfield {

/// Tiles side by side whose rays are reckoned together.
inline constexpr int kStripTiles = 32;
inline constexpr int kCorners = kStripTiles + 1;

/// The corners of a strip's tiles on one line. Where a ray is in the picture depends on its pixel and its nearness so
/// that it is farthest out at their ends.
struct alignas(64) CornerLine {
  float forward[kCorners];
  float x[kCorners];  ///< places
  float y[kCorners];
  float lowX[kCorners];  ///< of the texels that the rays pass
  float highX[kCorners];
  float lowY[kCorners];
  float highY[kCorners];
};

/// What can be said of a strip's tiles at once, 1 or 0.
struct StripTiles {
  int whole[kStripTiles];   ///< the rays at some of its corners go nowhere
  int misses[kStripTiles];  ///< none of its rays passes the picture
};

/// The corners on `line` of the frame from its column `left` on, for nearnesses of `range`.
void setCorners(const ViewWarp& warp, const CachedView::Range& range, int left, int line, CornerLine& corners);

/// Tells of the tiles between two lines of corners where they are in a picture of this size in texels.
void placeTiles(const CornerLine& above, const CornerLine& below, int width, int height, StripTiles& tiles);

}  // namespace grove::objects::lightfield
