#include "node/frontend/backdrops/light_error.h"

#include <algorithm>
#include <cmath>

namespace grove::node {
namespace {

/// Radiance reflected by a white surface, root mean square over the picture: about three levels of 255 of it.
constexpr float kPermittedRadiance = 0.04F;
/// Square metres. Limits the light on surfaces that are nearer to a lamp than its size.
constexpr float kLampSize = 0.6F;
/// Missing lights of the shorter list are dark.
constexpr world::PointLight kNoLight{};

struct Change {
  world::PointLight before;
  world::PointLight now;
};

std::vector<Change> changesOf(const std::vector<world::PointLight>& before, const std::vector<world::PointLight>& now) {
  std::vector<Change> changes;
  for (std::size_t i = 0; i < std::max(before.size(), now.size()); ++i) {
    const Change change{i < before.size() ? before[i] : kNoLight, i < now.size() ? now[i] : kNoLight};
    const bool isSame = change.before.position == change.now.position && change.before.colour == change.now.colour;
    if (!isSame) changes.push_back(change);
  }
  return changes;
}

world::Vec3 radiance(const world::PointLight& light, world::Vec3 point) {
  const world::Vec3 apart = light.position - point;
  return light.colour / (glm::dot(apart, apart) + kLampSize);
}

}  // namespace

float lightError(const Backdrop& backdrop, const std::vector<world::PointLight>& now) {
  const std::vector<Change> changes = changesOf(backdrop.view().lights, now);
  if (changes.empty()) return 0.0F;
  const world::Camera& camera = backdrop.view().camera;
  float sum = 0.0F;
  float pixels = 0.0F;
  for (const Backdrop::Block& block : backdrop.blocks()) {
    pixels += block.pixels;
    if (block.mean <= 0.0F) continue;
    const world::Vec3 point = camera.pose.position + camera.ray(block.centre.x, block.centre.y) / block.mean;
    world::Vec3 difference(0.0F);
    for (const Change& change : changes) difference += radiance(change.now, point) - radiance(change.before, point);
    sum += block.covered * glm::dot(difference, difference) / 3.0F;
  }
  return std::sqrt(sum / pixels) / kPermittedRadiance;
}

}  // namespace grove::node
