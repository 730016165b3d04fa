#pragma once

#include <span>

#include "raster/simd/rasteriser.h"

namespace grove::raster {

/// Draws front-facing triangles between corners where they are nearer than the target's depth. Shades are interpolated
/// in space, not on the screen. Two triangles that share an edge leave no gap and no overlap along it.
void drawTriangles(std::span<const Triangle> triangles, std::span<const Corner> corners, Canvas& canvas);

}  // namespace grove::raster
