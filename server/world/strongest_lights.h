#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "world/light.h"

namespace grove::world {

/// Returns at most `max` of the lights, strongest first, without those not stronger than `faintest`; `strength` returns
/// a light's strength in any unit.
template <class Strength>
[[nodiscard]] std::vector<PointLight> strongestLights(std::span<const PointLight> lights, std::size_t max,
                                                      float faintest, const Strength& strength) {
  struct Candidate {
    float strength;
    const PointLight* light;
  };
  std::vector<Candidate> candidates;
  candidates.reserve(lights.size());
  for (const PointLight& light : lights) {
    const float strong = strength(light);
    if (strong > faintest) candidates.push_back({strong, &light});
  }
  const std::size_t count = std::min(candidates.size(), max);
  std::ranges::partial_sort(candidates, candidates.begin() + static_cast<std::ptrdiff_t>(count), std::greater<>(),
                            &Candidate::strength);
  std::vector<PointLight> strongest;
  strongest.reserve(count);
  for (std::size_t i = 0; i < count; ++i) strongest.push_back(*candidates[i].light);
  return strongest;
}

}  // namespace grove::world
