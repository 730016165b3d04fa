#pragma once

#include <cstdint>

#include "objects/ground/frontend/grass_rows.h"

namespace grove::objects::ground {

/// Kernel: writes colours and depths of a row of the tile after findRoots(). Plants get the soil's light, darker
/// between the stalks than at the tips. `colour` and `depth` have room for kTile pixels.
void shadeRow(int row, const SoilBetween& soil, const GrassRows& grass, std::uint32_t* colour, float* depth);

}  // namespace grove::objects::ground
