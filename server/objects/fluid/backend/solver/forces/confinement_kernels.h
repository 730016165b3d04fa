#pragma once

#include <cstddef>

/// What VorticityConfinement does to a plane of cells. Pointers are to the first cell of a plane's row 0; all planes
/// lie as those of a Layout do.
namespace grove::objects::fluid {

struct ConfinementPlane {
  int cells = 0;
  std::ptrdiff_t stride = 0;  ///< between rows
};

/// The velocity in the middle of cells from its components' faces, ghosts included; `up` is the way to the next face.
void averageToCentres(const ConfinementPlane& plane, const float* faces, std::ptrdiff_t up, float* centres);

/// The velocity in the middle of cells: w is not needed from the planes around.
struct CentreVelocities {
  const float* u;
  const float* v;
  const float* w;
  const float* uBelow;
  const float* vBelow;
  const float* uAbove;
  const float* vAbove;
};
/// Twice the cell size times the vorticity, and its length.
struct Vorticity {
  float* x;
  float* y;
  float* z;
  float* length;  ///< also in the ghosts beside the cells: the nearest
};
void takeCurl(const ConfinementPlane& plane, const CentreVelocities& centres, const Vorticity& out);

/// What the force is made of.
struct ConstVorticity {
  const float* x;
  const float* y;
  const float* z;
  const float* length;
  const float* lengthBelow;
  const float* lengthAbove;
};
struct ForcePlanes {
  float* x;
  float* y;
  float* z;
};
/// out = gain * N x vorticity; N is the gradient of the length over its own length and `tiny`.
void takeConfinement(const ConfinementPlane& plane, const ConstVorticity& vorticity, float gain, float tiny,
                     const ForcePlanes& out);

struct ForcesAtCells {
  const float* x;
  const float* y;
  const float* z;
  const float* zBelow;  ///< null: there is no plane below
};
/// Adds the forces' means to the faces between cells: the plane's own, and those to the plane below.
void addToFaces(const ConfinementPlane& plane, const ForcesAtCells& forces, float* u, float* v, float* w);

}  // namespace grove::objects::fluid
