#pragma once

#include <cmath>
#include <cstddef>

#include "objects/ground/frontend/soil_kernels.h"

namespace grove::objects::ground {

/// Curves as strong as those of grass in the sun and as those in the dark, with all between.
inline SampledSoil soilWith(float phase) {
  SampledSoil soil;
  for (std::size_t i = 0; i < soil.grass.size(); ++i) {
    const float wave = 0.5F + 0.5F * std::sin(0.4F * static_cast<float>(i) + phase);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const float strength = wave * (1.0F - 0.2F * static_cast<float>(channel));
      soil.channels[channel].base[i] = 20.0F - 60.0F * strength;
      soil.channels[channel].slope[i] = 30.0F + 370.0F * strength;
      soil.channels[channel].square[i] = 20.0F - 140.0F * strength;
    }
    soil.grass[i] = wave;
  }
  return soil;
}

/// Straight between the samples.
inline float lineAt(const SoilSamples& samples, int column) {
  const auto left = static_cast<std::size_t>(column / kCoarse);
  const float share = static_cast<float>(column % kCoarse) / kCoarse;
  return samples[left] + (samples[left + 1] - samples[left]) * share;
}

}  // namespace grove::objects::ground
