#pragma once

#include <vector>

#include "models/plants/limb.h"

namespace grove::models {

/// A branching skeleton; a node's parent comes before it.
struct SkeletonNode {
  world::Vec3 position{0.0F};
  int parent = -1;
  float radius = 0.0F;
};
using Skeleton = std::vector<SkeletonNode>;

/// How branches compete for space: A. Runions, B. Lane, P. Prusinkiewicz, "Modeling Trees with a Space Colonization
/// Algorithm" (2007).
struct Colonisation {
  float step = 0.1F;     ///< metres between nodes
  float reached = 0.2F;  ///< metres: an attractor this close to a node is used up
  float sight = 10.0F;   ///< metres: how far an attractor draws nodes
  float tropism = 0.0F;  ///< upward pull as a share of the attractors'
  float wander = 0.1F;
};
void colonise(Skeleton& skeleton, std::vector<world::Vec3> attractors, const Colonisation& how, Random& random);

/// Radii by the pipe model: radius^exponent is the sum of the children's; ends have tipRadius.
void thicken(Skeleton& skeleton, float tipRadius, float exponent);

/// Takes the steps' corners out of the branches.
void smooth(Skeleton& skeleton);

/// One limb from each fork on along the thickest child, the trunk's first.
[[nodiscard]] std::vector<Limb> limbsOf(const Skeleton& skeleton);

}  // namespace grove::models
