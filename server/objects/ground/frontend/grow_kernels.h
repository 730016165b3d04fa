#pragma once

#include "objects/ground/frontend/grass_rows.h"
#include "objects/ground/frontend/meadow_sampling.h"

namespace grove::objects::ground {

/// Kernel: stores the plants at this row's pixels and the screen rows of their tops.
void growGrass(const Frame& frame, const GroundRow& ground, const Meadow& meadow, const MeadowSampling& sampling,
               const SoilBetween& soil, GrassRows& grass);

}  // namespace grove::objects::ground
