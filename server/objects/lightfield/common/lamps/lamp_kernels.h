#pragma once

#include <span>

#include "objects/lightfield/common/lamps/lamps.h"
#include "objects/lightfield/common/picture_part.h"
#include "objects/lightfield/format/view_camera.h"

namespace grove::objects::lightfield {

/// Adds the lamps' light: colour + colour * gain, clamped to the coverage. The gain of a lamp at a distance d is its
/// colour * (1 - (d / kLampReach)^2)^2 / (d^2 + the lamp's size).
void lightPart(std::span<const world::PointLight> lamps, const ObjectCamera& camera, const PicturePart& part);

/// Depth range of a part; farthest is 0 if the part is empty.
struct DepthRange {
  float nearest = kRelightFarthest;
  float farthest = 0.0F;
};
[[nodiscard]] DepthRange depthRange(const PicturePart& part);

}  // namespace grove::objects::lightfield
