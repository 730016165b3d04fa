#include "objects/lightfield/backend/near/half_planes.h"

#include <cmath>

namespace grove::objects::lightfield {
namespace {

/// Row of each column's sample, in sixteenths of a pixel.
constexpr std::array<int, kPixelSamples> kSampleRows{6, 12, 1, 9, 15, 4, 10, 2, 13, 7, 0, 5, 11, 14, 3, 8};

std::uint32_t samplesBeyond(float normalX, float normalY, float distance) {
  std::uint32_t mask = 0;
  for (std::size_t i = 0; i < kPixelSamples; ++i) {
    const float x = (static_cast<float>(i) + 0.5F) / kPixelSamples - 0.5F;
    const float y = (static_cast<float>(kSampleRows[i]) + 0.5F) / kPixelSamples - 0.5F;
    if (normalX * x + normalY * y + distance >= 0.0F) mask |= 1U << i;
  }
  return mask;
}

}  // namespace

HalfPlanes::HalfPlanes() {
  for (std::size_t slope = 0; slope < kSlopes; ++slope) {
    const float x = 2.0F * static_cast<float>(slope) / (kSlopes - 1) - 1.0F;
    const float y = 1.0F - std::abs(x);
    const float length = std::hypot(x, y);
    for (std::size_t i = 0; i < kDistances; ++i) {
      const float distance = (static_cast<float>(i) + 0.5F - 0.5F * kDistances) * kDistanceStep;
      const std::uint32_t mask = samplesBeyond(x / length, y / length, distance);
      masks_[slope].low[i] = static_cast<std::uint8_t>(mask);
      masks_[slope].high[i] = static_cast<std::uint8_t>(mask >> 8U);
      masks_[slope + kSlopes].low[i] = static_cast<std::uint8_t>(~mask);
      masks_[slope + kSlopes].high[i] = static_cast<std::uint8_t>(~mask >> 8U);
    }
  }
}

}  // namespace grove::objects::lightfield
