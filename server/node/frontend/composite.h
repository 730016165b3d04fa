#pragma once

#include "node/image.h"

namespace grove::node {

/// Makes every pixel black, opaque and infinitely far.
void clear(Image& frame);

/// Lays a layer over the whole frame wherever it is not farther than what is there, blended by its coverage. Pixels
/// that are covered for more than half take over the layer's depth. The layer's rectangle must lie within the frame.
void compositeByDepth(const Image& layer, Image& frame);

}  // namespace grove::node
