#pragma once

#include <memory>

#include "node/image.h"
#include "objects/sky/panorama.h"
#include "world/camera.h"

namespace grove::objects::sky {

/// What a camera sees of the sky within `rect`, cropped to the rows that the ground does not certainly cover; null
/// if none is left. Depth is kInfiniteDepth. Any thread.
[[nodiscard]] std::shared_ptr<const node::Image> skyImage(const SkyMaps& maps, const world::Camera& camera,
                                                          world::Rect rect, node::ImagePool& images);

}  // namespace grove::objects::sky
