#pragma once

#include "objects/ground/frontend/grass_rows.h"

namespace grove::objects::ground {

/// Kernel: finds the blade of each pixel of a row among the `reach` nearer rows, fewer than kRootRows - 1.
void findRoots(const Row& row, int reach, const SoilBetween& soil, GrassRows& grass);

}  // namespace grove::objects::ground
