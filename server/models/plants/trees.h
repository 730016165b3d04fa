#pragma once

#include "models/plants/mesh_writer.h"
#include "models/plants/plants.h"
#include "models/plants/random.h"

/// What makePlant() grows trees with; each stands at the origin. Twigs and leaves stay where they are at every detail:
/// only the triangles they are made of differ.
namespace grove::models {

void growOak(MeshWriter& mesh, Random& random, Detail detail);
void growBirch(MeshWriter& mesh, Random& random, Detail detail);
void growSpruce(MeshWriter& mesh, Random& random, Detail detail);

}  // namespace grove::models
