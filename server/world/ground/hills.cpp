#include "world/ground/hills.h"

#include <algorithm>

namespace grove::world {
namespace {

/// 1 at the centre of a hill, 0 at its edge and beyond.
float shareOf(const Hill& hill, Vec2 place) {
  const Vec2 away = (place - hill.centre) / hill.radius;
  return std::max(1.0F - glm::dot(away, away), 0.0F);
}

}  // namespace

float groundHeight(std::span<const Hill> hills, Vec2 place) noexcept {
  float sum = 0.0F;
  for (const Hill& hill : hills) {
    const float share = shareOf(hill, place);
    sum += hill.height * share * share;
  }
  return sum;
}

Vec2 groundSlope(std::span<const Hill> hills, Vec2 place) noexcept {
  Vec2 sum(0.0F);
  for (const Hill& hill : hills) {
    sum -= (place - hill.centre) * (4.0F * hill.height * shareOf(hill, place) / (hill.radius * hill.radius));
  }
  return sum;
}

}  // namespace grove::world
