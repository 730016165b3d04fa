#include <algorithm>

#include "objects/figure/backend/shadow/shadow_grid.h"

namespace grove::objects::figure {
namespace {

/// A place in an array of sums over the texels before each one.
struct SumPlace {
  std::size_t before;
  float beyond;  ///< share of the next texel
};

/// Nothing lies beyond the ends of `count` texels.
SumPlace sumPlaceOf(float place, std::size_t count) {
  const float inside = std::clamp(place, 0.0F, static_cast<float>(count));
  const std::size_t before = std::min(static_cast<std::size_t>(inside), count - 1);
  return {before, inside - static_cast<float>(before)};
}

void softenAcross(ShadowRow& row, float radius) {
  // Sums over the texels before each one, with the same beyond both ends as at them.
  constexpr std::size_t kFirst = kShadowColumns;
  std::array<float, 3 * kShadowColumns + 2> sums{};
  for (std::size_t i = 0; i < kShadowColumns; ++i) sums[kFirst + i + 1] = sums[kFirst + i] + row[i];
  std::fill(sums.begin() + kFirst + kShadowColumns + 1, sums.end(), sums[kFirst + kShadowColumns]);
  const float most = static_cast<float>(kShadowColumns) - 1.0F;
  const SumPlace from = sumPlaceOf(static_cast<float>(kFirst) + 0.5F - std::min(radius, most), sums.size() - 1);
  const SumPlace to = sumPlaceOf(static_cast<float>(kFirst) + 0.5F + std::min(radius, most), sums.size() - 1);
  for (std::size_t i = 0; i < kShadowColumns; ++i) {
    const float before = glm::mix(sums[from.before + i], sums[from.before + i + 1], from.beyond);
    const float after = glm::mix(sums[to.before + i], sums[to.before + i + 1], to.beyond);
    row[i] = (after - before) / (2.0F * radius);
  }
}

}  // namespace

void soften(ShadowGrid& grid, std::span<const world::Vec2> radii) {
  ShadowGrid sums(kShadowRows + 1);
  for (std::size_t y = 0; y < kShadowRows; ++y) {
    softenAcross(grid[y], radii[y].x);
    for (std::size_t x = 0; x < kShadowColumns; ++x) sums[y + 1][x] = sums[y][x] + grid[y][x];
  }
  for (std::size_t y = 0; y < kShadowRows; ++y) {
    const float middle = static_cast<float>(y) + 0.5F;
    const SumPlace from = sumPlaceOf(middle - radii[y].y, kShadowRows);
    const SumPlace to = sumPlaceOf(middle + radii[y].y, kShadowRows);
    for (std::size_t x = 0; x < kShadowColumns; ++x) {
      const float before = glm::mix(sums[from.before][x], sums[from.before + 1][x], from.beyond);
      const float after = glm::mix(sums[to.before][x], sums[to.before + 1][x], to.beyond);
      grid[y][x] = (after - before) / (2.0F * radii[y].y);
    }
  }
}

}  // namespace grove::objects::figure
