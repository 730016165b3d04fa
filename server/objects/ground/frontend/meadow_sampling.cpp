#include "objects/ground/frontend/meadow_sampling.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::ground {
namespace {

/// Distant grass uses up to this many levels coarser than the pixel's footprint; otherwise it sparkles when the eye
/// moves.
constexpr float kSoftness = 0.5F;

}  // namespace

MeadowSampling samplingFor(const Row& row, const Meadow& meadow) {
  const float texel = meadow.metres / static_cast<float>(meadow.pyramid.size());
  MeadowSampling sampling;
  sampling.taps = row.along < 2.0F * texel ? 1 : row.along < 8.0F * row.across ? 2 : 4;
  const float even = std::sqrt(row.across * row.along);
  const float size = std::max(row.across, std::min(even, row.along / static_cast<float>(sampling.taps)));
  const float exact = std::max(0.0F, std::log2(size / texel));
  const auto coarsest = static_cast<float>(meadow.pyramid.levels() - 5);
  const float lod = std::clamp(exact + std::min(exact, kSoftness), 0.0F, coarsest);
  sampling.level = static_cast<int>(lod);
  sampling.coarser = lod - std::floor(lod);
  return sampling;
}

}  // namespace grove::objects::ground
