#pragma once

#include "models/plants/mesh_writer.h"
#include "models/plants/plants.h"
#include "models/plants/random.h"

/// Grows tiles for makePlant().
///
/// Tiles fit at any edge and in any rotation, because everything near an edge is independent of the tile: the soil
/// there is one field over the whole plane, with the symmetry of the tiling, and the plants there are copies of one
/// wedge, six times. Everything that belongs to a single tile keeps away from the edges.
namespace grove::models {

/// Distance in metres on either side of an edge within which all tiles are the same.
inline constexpr float kEdgeStrip = 0.12F;

/// Distance in metres from an edge to the innermost plant that all tiles share.
inline constexpr float kCommonDepth = 0.45F;

/// Metres by which the soil extends beyond the edges, exactly on the neighbour's soil: a texel across the edge never
/// shows the background.
inline constexpr float kSkirt = 0.04F;

void growMeadow(MeshWriter& mesh, Random& random, Detail detail);
void growFlowers(MeshWriter& mesh, Random& random, Detail detail);
void growFern(MeshWriter& mesh, Random& random, Detail detail);

}  // namespace grove::models
