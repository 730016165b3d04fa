#pragma once

#include "models/plants/mesh_writer.h"
#include "models/plants/plants.h"
#include "models/plants/random.h"

/// Grows trees and shrubs for makePlant(), each at the origin. Twigs and leaves have the same places at small and full
/// detail; only their triangles differ. Distant plants have fewer and larger leaves, which cover the same area.
namespace grove::models {

void growOak(MeshWriter& mesh, Random& random, Detail detail);
void growBirch(MeshWriter& mesh, Random& random, Detail detail);
void growSpruce(MeshWriter& mesh, Random& random, Detail detail);
void growPine(MeshWriter& mesh, Random& random, Detail detail);
void growHazel(MeshWriter& mesh, Random& random, Detail detail);

}  // namespace grove::models
