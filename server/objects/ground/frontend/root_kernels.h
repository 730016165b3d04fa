#pragma once

#include "objects/ground/frontend/grass_rows.h"

namespace grove::objects::ground {

/// Kernel: finds each pixel's blade among the `reach` nearer rows; `reach` is less than kRootRows - 1.
void findRoots(const Row& row, int reach, const SoilBetween& soil, GrassRows& grass);

}  // namespace grove::objects::ground
