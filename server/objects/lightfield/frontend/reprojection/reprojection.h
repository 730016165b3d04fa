#pragma once

#include <functional>

#include "objects/lightfield/common/cached_view.h"
#include "objects/lightfield/common/layered_haze.h"
#include "objects/lightfield/frontend/reprojection/reprojection_tile.h"
#include "world/camera.h"

namespace grove::objects::lightfield {

/// Receives the pixels of a part of the frame: colour and depth of the tile's first rows and columns; may change them.
using LayTile = std::function<void(const world::Rect& part, WarpTile& tile)>;

/// Returns whether everything at `depth` or farther is hidden in this part of the frame.
using HidesTile = std::function<bool(const world::Rect& part, float depth)>;

/// Draws a cached view for an eye of its cell, through haze: the per-visitor cost of every frame. Iterates over `rect`,
/// in pixels of `camera`, and passes covered tiles on while they are in the processor's nearest cache. Skips the parts
/// for which `hides` returns true.
///
/// Follows each pixel's ray through the picture, along which it moves by a few texels at most, to the nearest texel on
/// it. A ray that passes behind an edge without a hit takes the farthest texel that it passed: the surface behind the
/// edge continues. Vectorised. Any thread.
void reproject(const CachedView& view, const ObjectCamera& camera, const LayeredHaze& haze, const world::Rect& rect,
               const LayTile& lay, const HidesTile& hides);

}  // namespace grove::objects::lightfield
