#pragma once

#include <vector>

#include "objects/mesh/drawing.h"

/// What shaders/mesh/ computes, for the renderer that traces rays. A test holds the two together.
namespace grove::objects::mesh {

/// Cells per metre of the finest procedural detail, which shows only where a cell is larger than three pixels.
inline constexpr float kFineDetail = 31.0F;

/// What mesh.vert hands to mesh.frag, by the same names; linear over a triangle.
struct Varyings {
  world::Vec3 place{0.0F};
  world::Vec3 facing{0.0F};
  world::Vec3 paint{0.0F};
  float grain = 0.0F;
  float lichen = 0.0F;
  float sun = 0.0F;
  world::Vec3 indirect{0.0F};
  world::Vec3 added{0.0F};
  float cleared = 0.0F;
};

/// mesh.vert for all vertices of a drawing.
[[nodiscard]] std::vector<Varyings> shadeVertices(const Drawing& drawing);

[[nodiscard]] Varyings interpolate(const Varyings& a, const Varyings& b, const Varyings& c, float u, float v);

/// mesh.frag: linear radiance. `pixelsPerMetre` is that at the point's depth.
[[nodiscard]] world::Vec3 shadePixel(const Varyings& at, float pixelsPerMetre);

}  // namespace grove::objects::mesh
