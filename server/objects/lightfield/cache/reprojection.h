#pragma once

#include "node/image.h"
#include "objects/lightfield/cache/cached_view.h"
#include "objects/lightfield/sampler.h"

namespace grove::objects::lightfield {

/// Draws a cached view for an eye of its cell, through the haze: what every visitor pays in every frame. Fills the
/// image's spans (kInfiniteDepth where there is nothing within them); its rectangle is in pixels of `camera`.
///
/// Each pixel's ray is followed through the picture, along which it moves by a few texels at most, and meets the
/// nearest texel that lies on it. Where it passes behind an edge and meets none, it shows the farthest texel that it
/// passed: what lies behind the edge goes on. Vectorised. Any thread.
void reproject(const CachedView& view, const ObjectCamera& camera, const Haze& haze, node::Image& image);

}  // namespace grove::objects::lightfield
