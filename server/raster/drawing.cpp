#include "raster/drawing.h"

#include <algorithm>

namespace grove::raster {
namespace {

/// A lamp that adds less than this to a white surface cannot be seen.
constexpr float kFaintest = 0.002F;

float strongest(const world::PointLight& light, const world::Bounds& bounds) {
  const world::Vec3 nearest = glm::clamp(light.position, bounds.low, bounds.high);
  const world::Vec3 away = light.position - nearest;
  return std::max({light.colour.r, light.colour.g, light.colour.b}) / (glm::dot(away, away) + 0.02F);
}

}  // namespace

Lamps chooseLamps(std::span<const world::PointLight> lights, const world::Bounds& bounds) {
  struct Candidate {
    float strength;
    const world::PointLight* light;
  };
  std::vector<Candidate> candidates;
  candidates.reserve(lights.size());
  for (const world::PointLight& light : lights) {
    const float strength = strongest(light, bounds);
    if (strength > kFaintest) candidates.push_back({strength, &light});
  }
  const std::size_t count = std::min(candidates.size(), kMaxLamps);
  std::ranges::partial_sort(candidates, candidates.begin() + static_cast<std::ptrdiff_t>(count),
                            [](const Candidate& a, const Candidate& b) { return a.strength > b.strength; });
  Lamps lamps;
  lamps.count = static_cast<int>(count);
  for (std::size_t i = 0; i < count; ++i) {
    lamps.position[i] = candidates[i].light->position;
    lamps.colour[i] = candidates[i].light->colour;
  }
  return lamps;
}

}  // namespace grove::raster
