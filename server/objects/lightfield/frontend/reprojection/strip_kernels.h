#pragma once

#include "objects/lightfield/common/cached_view.h"
#include "objects/lightfield/frontend/reprojection/reprojection_tile.h"

namespace grove::objects::lightfield {

/// Adjacent tiles whose rays are computed together.
inline constexpr int kStripTiles = 32;
inline constexpr int kCorners = kStripTiles + 1;

/// The corners of a strip's tiles on one line. A ray's position in the picture is a function of pixel and nearness with
/// its extremes at the ends of both.
struct alignas(64) CornerLine {
  float forward[kCorners];
  float x[kCorners];  ///< positions
  float y[kCorners];
  float lowX[kCorners];  ///< of the texels that the rays pass
  float highX[kCorners];
  float lowY[kCorners];
  float highY[kCorners];
};

/// Properties of a strip's tiles, 1 or 0.
struct StripTiles {
  int whole[kStripTiles];   ///< the rays at some of its corners have no position in the picture
  int misses[kStripTiles];  ///< none of its rays passes the picture
};

/// Computes the corners on `line` of the frame from its column `left` on, for nearnesses in `range`.
void setCorners(const ViewWarp& warp, const CachedView::Range& range, int left, int line, CornerLine& corners);

/// Computes the positions of the tiles between two lines of corners in a picture of this size in texels.
void placeTiles(const CornerLine& above, const CornerLine& below, int width, int height, StripTiles& tiles);

}  // namespace grove::objects::lightfield
