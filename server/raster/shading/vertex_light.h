#pragma once

#include <cstdint>
#include <span>

#include "raster/vertex_arrays.h"

namespace grove::raster {

/// The largest weight of the sun's relief in vertex light; see lightVertices().
inline constexpr float kMaxRelief = 4.0F;

/// Computes the light that the first `out.size()` vertices send to the drawing's eye through haze: RGB display-encoded;
/// A is the share (of kMaxRelief) of its brightness that changes per unit of slope towards the sun, for the procedural
/// relief. All renderers interpolate it over their triangles. `arrays` comes from the drawing's object.
void lightVertices(const VertexArrays& arrays, const Drawing& drawing, std::span<std::uint32_t> out);

}  // namespace grove::raster
