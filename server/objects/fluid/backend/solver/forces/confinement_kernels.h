#pragma once

#include <cstddef>

/// Passes of VorticityConfinement over a plane of cells. Pointers are to the first cell of a plane's row 0; all planes
/// have the strides of a Layout.
namespace grove::objects::fluid {

struct ConfinementPlane {
  int cells = 0;
  std::ptrdiff_t stride = 0;  ///< between rows
};

/// Averages a component from faces to cell centres, ghosts included; `up` is the offset of the next face.
void averageToCentres(const ConfinementPlane& plane, const float* faces, std::ptrdiff_t up, float* centres);

/// The velocity at cell centres. The curl needs no w of the adjacent planes.
struct CentreVelocities {
  const float* u;
  const float* v;
  const float* w;
  const float* uBelow;
  const float* vBelow;
  const float* uAbove;
  const float* vAbove;
};
/// 2 * cell size * vorticity, and its length.
struct Vorticity {
  float* x;
  float* y;
  float* z;
  float* length;  ///< also filled in the ghosts beside the cells, with the nearest value
};
void takeCurl(const ConfinementPlane& plane, const CentreVelocities& centres, const Vorticity& out);

/// Inputs of the force.
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
/// out = gain * N x vorticity; N is the gradient of the length divided by its own length plus `tiny`.
void takeConfinement(const ConfinementPlane& plane, const ConstVorticity& vorticity, float gain, float tiny,
                     const ForcePlanes& out);

struct ForcesAtCells {
  const float* x;
  const float* y;
  const float* z;
  const float* zBelow;  ///< null: there is no plane below
};
/// Adds the mean of adjacent cells' forces to the faces between them: the plane's own faces and those to the plane
/// below.
void addToFaces(const ConfinementPlane& plane, const ForcesAtCells& forces, float* u, float* v, float* w);

}  // namespace grove::objects::fluid
