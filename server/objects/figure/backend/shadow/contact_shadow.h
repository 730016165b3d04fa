#pragma once

#include "objects/figure/backend/shadow/ground_row.h"
#include "objects/figure/backend/shadow/row_shade.h"

namespace grove::objects::figure {

/// Radius of the shadow around a place. Metres.
inline constexpr float kShadowRadius = 0.42F;

/// Adds what a figure at `place` takes from the sky: a soft round shadow.
void addContactShadow(world::Vec3 place, const GroundRow& row, RowShade& shade);

}  // namespace grove::objects::figure
