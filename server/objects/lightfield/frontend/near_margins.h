#pragma once

#include "objects/lightfield/frontend/near_views.h"

namespace grove::objects::lightfield {

/// What a visitor's own picture of an object shows, for it is to serve the next frames, too: the box `rect` of the
/// object in the frame, and beyond the frame's edges what a head soon sees that goes on turning as it has since the
/// last picture. `camera` is the frame's in the object's coordinates; `last` may have no picture; a texel of the new
/// one is `times` as wide as a pixel.
[[nodiscard]] world::Rect withMargins(const world::Rect& rect, const world::Camera& frame, const ObjectCamera& camera,
                                      const NearView& last, float times);

}  // namespace grove::objects::lightfield
