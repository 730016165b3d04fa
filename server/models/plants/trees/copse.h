#pragma once

#include "models/plants/mesh_writer.h"
#include "models/plants/plants.h"
#include "models/plants/random.h"

namespace grove::models {

/// Grows a round group of trees of several kinds and ages for makePlant(), with the tallest in the middle and shrubs
/// and young trees at its rim, about 19 m across: a piece of forest that is one light field. Its trees have one level
/// of detail less than `detail`.
void growCopse(MeshWriter& mesh, Random& random, Detail detail);

}  // namespace grove::models
