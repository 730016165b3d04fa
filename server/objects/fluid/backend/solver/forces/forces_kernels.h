#pragma once

#include "objects/fluid/backend/solver/grid.h"
#include "objects/fluid/backend/solver/pressure/projection_kernels.h"

/// Forces on the plane `z`; pointers are to whole fields of a Layout.
namespace grove::objects::fluid {

/// The wind's drag: every face keeps a share `keep` of its velocity and gains the wind's steady part, its whirls (sines
/// and cosines at the cell centres along each axis) and `lift` * the temperatures on both sides.
struct WindPush {
  float keep = 1.0F;
  float steady[3] = {};
  const float* sine[3] = {};
  const float* cosine[3] = {};
  float lift = 0.0F;
};
/// z may equal the number of cells.
void pushPlane(const Layout& layout, int z, const WindPush& push, const float* temperature,
               const VelocityPointers& velocity);

/// A gust's cone, in metres and metres per second.
struct GustCone {
  float origin[3] = {};
  float direction[3] = {};  ///< unit vector
  float speed = 0.0F;
  float reach = 1.0F;
};
/// Pulls the faces of one axis inside the cone towards the wind's speed.
void blowPlane(const Layout& layout, int z, int axis, const GustCone& gust, float cellSize, float* faces);

/// Cools a plane of temperatures over `seconds`.
void coolPlane(const Layout& layout, int z, float seconds, float* temperature);

}  // namespace grove::objects::fluid
