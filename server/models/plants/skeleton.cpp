#include "models/plants/skeleton.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace grove::models {
namespace {

using world::Vec3;

struct Attractor {
  Vec3 position{0.0F};
  std::size_t nearest = 0;
  float distance = 1.0e30F;
};

/// For each node, the child that continues its limb, -1 at ends.
std::vector<int> thickestChildren(const Skeleton& skeleton) {
  std::vector<int> thickest(skeleton.size(), -1);
  for (std::size_t i = 0; i < skeleton.size(); ++i) {
    if (skeleton[i].parent < 0) continue;
    int& child = thickest[static_cast<std::size_t>(skeleton[i].parent)];
    if (child < 0 || skeleton[i].radius > skeleton[static_cast<std::size_t>(child)].radius) child = static_cast<int>(i);
  }
  return thickest;
}

}  // namespace

void colonise(Skeleton& skeleton, std::vector<Vec3> positions, const Colonisation& how, Random& random) {
  std::vector<Attractor> attractors;
  for (const Vec3 position : positions) attractors.push_back({position});
  // A node between two opposing attractors would grow the same child forever.
  std::vector<int> children(skeleton.size(), 0);
  std::size_t known = 0;
  while (known < skeleton.size() && !attractors.empty()) {
    for (Attractor& attractor : attractors) {
      for (std::size_t i = known; i < skeleton.size(); ++i) {
        const float distance = glm::distance(attractor.position, skeleton[i].position);
        if (distance < attractor.distance) {
          attractor.distance = distance;
          attractor.nearest = i;
        }
      }
    }
    known = skeleton.size();
    std::erase_if(attractors, [&](const Attractor& attractor) { return attractor.distance < how.reached; });
    std::vector<Vec3> pull(known, Vec3(0.0F));
    for (const Attractor& attractor : attractors) {
      if (attractor.distance > how.sight) continue;
      pull[attractor.nearest] += (attractor.position - skeleton[attractor.nearest].position) / attractor.distance;
    }
    for (std::size_t i = 0; i < known; ++i) {
      if (pull[i] == Vec3(0.0F) || children[i] >= 3) continue;
      const Vec3 wanted = unitOr(pull[i], Vec3(0, 1, 0)) + Vec3(0, how.tropism, 0) + random.direction() * how.wander;
      skeleton.push_back({skeleton[i].position + unitOr(wanted, Vec3(0, 1, 0)) * how.step, static_cast<int>(i), 0.0F});
      children.push_back(0);
      ++children[i];
    }
  }
}

void thicken(Skeleton& skeleton, float tipRadius, float exponent) {
  std::vector<float> area(skeleton.size(), 0.0F);
  for (std::size_t i = skeleton.size(); i-- > 0;) {
    if (area[i] == 0.0F) area[i] = std::pow(tipRadius, exponent);
    skeleton[i].radius = std::pow(area[i], 1.0F / exponent);
    if (skeleton[i].parent >= 0) area[static_cast<std::size_t>(skeleton[i].parent)] += area[i];
  }
}

void smooth(Skeleton& skeleton) {
  const std::vector<int> thickest = thickestChildren(skeleton);
  const Skeleton before = skeleton;
  for (std::size_t i = 0; i < skeleton.size(); ++i) {
    if (before[i].parent < 0 || thickest[i] < 0) continue;
    const Vec3 middle = 0.5F * (before[static_cast<std::size_t>(before[i].parent)].position +
                                before[static_cast<std::size_t>(thickest[i])].position);
    skeleton[i].position = glm::mix(before[i].position, middle, 0.6F);
  }
}

std::vector<Limb> limbsOf(const Skeleton& skeleton) {
  const std::vector<int> thickest = thickestChildren(skeleton);
  std::vector<Limb> limbs;
  for (std::size_t i = 0; i < skeleton.size(); ++i) {
    const int parent = skeleton[i].parent;
    if (parent >= 0 && thickest[static_cast<std::size_t>(parent)] == static_cast<int>(i)) continue;
    Limb limb;
    if (parent >= 0) {
      const SkeletonNode& root = skeleton[static_cast<std::size_t>(parent)];
      limb.points.push_back({root.position, std::min(root.radius, 1.2F * skeleton[i].radius)});
    }
    for (int at = static_cast<int>(i); at >= 0; at = thickest[static_cast<std::size_t>(at)]) {
      const SkeletonNode& node = skeleton[static_cast<std::size_t>(at)];
      limb.points.push_back({node.position, node.radius});
    }
    if (limb.points.size() >= 2) limbs.push_back(std::move(limb));
  }
  return limbs;
}

}  // namespace grove::models
