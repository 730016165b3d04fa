#include "objects/ground/frontend/relief/ground_row.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace grove::objects::ground {

Row meanOf(const Frame& frame, const GroundRow& ground) noexcept {
  float inverse = 0.0F;
  float step = 0.0F;
  for (std::size_t i = 0; i < kCoarseSamples; ++i) {
    inverse += 1.0F / ground.depth[i];
    step += ground.step[i];
  }
  inverse /= kCoarseSamples;
  step /= kCoarseSamples;
  const float depth = 1.0F / inverse;
  return {ground.row,
          depth,
          ground.ahead,
          ground.rise,
          std::max(0.0F, frame.focal * ground.ahead * inverse),
          depth * frame.sideStep,
          step * std::max(0.05F, std::fabs(ground.ahead))};
}

std::vector<world::Hill> hillsBefore(const Frame& frame, int firstColumn, int top, int bottom,
                                     std::span<const world::Hill> hills) {
  const auto aheadOf = [&](int row) { return frame.firstAhead + static_cast<float>(row) * frame.aheadStep; };
  const auto [low, high] = std::minmax({aheadOf(top), aheadOf(bottom)});
  // Rays that go almost straight down spread in all directions.
  constexpr float kMinAhead = 0.2F;
  if (low < kMinAhead) return {hills.begin(), hills.end()};
  const float left = frame.firstSide + static_cast<float>(firstColumn) * frame.sideStep;
  const float right = left + static_cast<float>(kTile) * frame.sideStep;
  const float leftmost = std::min(left / low, left / high);
  const float rightmost = std::max(right / low, right / high);
  const auto isBefore = [&](const world::Hill& hill) {
    const world::Vec2 way = hill.centre - world::Vec2(frame.eyeX, frame.eyeZ);
    const float ahead = way.x * frame.forwardX + way.y * frame.forwardZ;
    const float side = way.x * frame.sideX + way.y * frame.sideZ;
    return ahead > -hill.radius && side - leftmost * ahead > -hill.radius * std::hypot(1.0F, leftmost) &&
           side - rightmost * ahead < hill.radius * std::hypot(1.0F, rightmost);
  };
  std::vector<world::Hill> result;
  std::ranges::copy_if(hills, std::back_inserter(result), isBefore);
  return result;
}

}  // namespace grove::objects::ground
