#pragma once

#include "objects/fluid/backend/solver/grid.h"
#include "objects/fluid/backend/solver/pressure/projection_kernels.h"

/// What forces do to the plane `z`; pointers are to whole fields of a Layout.
namespace grove::objects::fluid {

/// The wind's pull: every face keeps a share `keep` of its velocity and is pushed by the wind's steady part, by its
/// whirls (sines and cosines at the middles of cells along each axis) and by `lift` * the temperatures on both sides.
struct WindPush {
  float keep = 1.0F;
  float steady[3] = {};
  const float* sine[3] = {};
  const float* cosine[3] = {};
  float lift = 0.0F;
};
/// z may be the number of cells.
void pushPlane(const Layout& layout, int z, const WindPush& push, const float* temperature,
               const VelocityPointers& velocity);

/// A gust's cone, in metres and metres a second.
struct GustCone {
  float origin[3] = {};
  float direction[3] = {};  ///< of length 1
  float speed = 0.0F;
  float reach = 1.0F;
};
/// Faces of one axis in the cone take up the wind's speed.
void blowPlane(const Layout& layout, int z, int axis, const GustCone& gust, float cellSize, float* faces);

/// Cools a plane of temperatures over `seconds`.
void coolPlane(const Layout& layout, int z, float seconds, float* temperature);

}  // namespace grove::objects::fluid
