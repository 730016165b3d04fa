#pragma once

#include "models/plants/mesh_writer.h"
#include "models/plants/plants.h"
#include "models/plants/random.h"

/// Grows trees for makePlant(), each at the origin. Twigs and leaves have the same places at every detail; only their
/// triangles differ.
namespace grove::models {

void growOak(MeshWriter& mesh, Random& random, Detail detail);
void growBirch(MeshWriter& mesh, Random& random, Detail detail);
void growSpruce(MeshWriter& mesh, Random& random, Detail detail);

}  // namespace grove::models
