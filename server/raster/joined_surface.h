#pragma once

#include <span>

#include "raster/surface.h"

namespace grove::raster {

/// Joins parts, each with levels down to an error of 0, to one surface. Each of its levels refines the part that gains
/// most for its triangles. The errors of parts add up as squares; the coarsest level has that of its worst part.
/// Vertices are those of the parts, one part after the other.
[[nodiscard]] Surface joined(std::span<const Surface> parts);

}  // namespace grove::raster
