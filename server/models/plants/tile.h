#pragma once

#include "models/plants/mesh_writer.h"
#include "models/plants/plants.h"
#include "models/plants/random.h"

/// What makePlant() grows tiles with.
///
/// Tiles fit at any edge and in any rotation because what lies near an edge does not depend on the tile: the soil there
/// is one field over the whole plane, with the symmetry of the tiling, that every tile evaluates; and the plants there
/// are one and the same wedge, six times. All that belongs to a tile alone keeps away from the edges.
namespace grove::models {

/// Metres from an edge within which, and beyond which, everything is the same in all tiles.
inline constexpr float kEdgeStrip = 0.12F;

/// Metres from an edge to the innermost plant that all tiles have.
inline constexpr float kCommonDepth = 0.45F;

/// Metres that the soil goes on beyond the edges, where it lies exactly on the neighbour's: a texel that the edge parts
/// never shows what is behind.
inline constexpr float kSkirt = 0.04F;

void growMeadow(MeshWriter& mesh, Random& random, Detail detail);
void growFlowers(MeshWriter& mesh, Random& random, Detail detail);
void growFern(MeshWriter& mesh, Random& random, Detail detail);

}  // namespace grove::models
