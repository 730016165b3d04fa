#pragma once

#include <functional>

#include "objects/lightfield/common/cached_view.h"
#include "objects/lightfield/common/haze.h"
#include "objects/lightfield/frontend/reprojection/reprojection_tile.h"
#include "world/camera.h"

namespace grove::objects::lightfield {

/// Takes the pixels of a part of the frame: colour and depth of the tile's first rows and columns, which it may change.
using LayTile = std::function<void(const world::Rect& part, WarpTile& tile)>;

/// Whether nothing that is nowhere nearer than `depth` would show in this part of the frame.
using HidesTile = std::function<bool(const world::Rect& part, float depth)>;

/// Draws a cached view for an eye of its cell, through the haze: what every visitor pays in every frame. Goes over
/// `rect`, in pixels of `camera`, and hands on what shows anything, while it is in the processor's nearest cache. Parts
/// that `hides` says are hidden are left out.
///
/// Each pixel's ray is followed through the picture, along which it moves by a few texels at most, and meets the
/// nearest texel that lies on it. Where it passes behind an edge and meets none, it shows the farthest texel that it
/// passed: what lies behind the edge goes on. Vectorised. Any thread.
void reproject(const CachedView& view, const ObjectCamera& camera, const Haze& haze, const world::Rect& rect,
               const LayTile& lay, const HidesTile& hides);

}  // namespace grove::objects::lightfield
