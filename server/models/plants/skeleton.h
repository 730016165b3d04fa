#pragma once

#include <vector>

#include "models/plants/limb.h"

namespace grove::models {

/// A branching skeleton; parents come before their children.
struct SkeletonNode {
  world::Vec3 position{0.0F};
  int parent = -1;
  float radius = 0.0F;
};
using Skeleton = std::vector<SkeletonNode>;

/// Parameters of the branches' competition for space: A. Runions, B. Lane, P. Prusinkiewicz, "Modeling Trees with a
/// Space Colonization Algorithm" (2007).
struct Colonisation {
  float step = 0.1F;     ///< metres between nodes
  float reached = 0.2F;  ///< metres: attractors this close to a node are removed
  float sight = 10.0F;   ///< metres: range of an attractor
  float tropism = 0.0F;  ///< upward pull as a share of the attractors'
  float wander = 0.1F;
};
void colonise(Skeleton& skeleton, std::vector<world::Vec3> attractors, const Colonisation& how, Random& random);

/// Radii by the pipe model: radius^exponent is the sum over the children; ends have tipRadius.
void thicken(Skeleton& skeleton, float tipRadius, float exponent);

/// Smooths the corners that the growth steps leave in branches.
void smooth(Skeleton& skeleton);

/// One limb per fork, along the thickest children; the trunk's first.
[[nodiscard]] std::vector<Limb> limbsOf(const Skeleton& skeleton);

}  // namespace grove::models
