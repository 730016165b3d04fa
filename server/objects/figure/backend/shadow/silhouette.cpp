#include <algorithm>
#include <cmath>
#include <cstdint>

#include "objects/figure/backend/shadow/shadow_grid.h"

namespace grove::objects::figure {
namespace {

using world::Vec2;

constexpr int kSampleColumns = 2 * kShadowColumns;
constexpr int kSampleRows = 2 * kShadowRows;
using Samples = std::vector<std::array<std::uint8_t, kSampleColumns>>;

/// The first sample whose middle is not before a place.
int firstSample(float place) { return static_cast<int>(std::ceil(place - 0.5F)); }

/// `corners` are in samples.
void cover(const std::array<Vec2, 3>& corners, Samples& samples) {
  const auto [lowest, highest] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
  const int end = std::min(firstSample(highest), kSampleRows);
  for (int row = std::max(firstSample(lowest), 0); row < end; ++row) {
    const float y = static_cast<float>(row) + 0.5F;
    float left = static_cast<float>(kSampleColumns);
    float right = 0.0F;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2 from = corners[i];
      const Vec2 to = corners[(i + 1) % corners.size()];
      if ((from.y <= y) == (to.y <= y)) continue;
      const float x = glm::mix(from.x, to.x, (y - from.y) / (to.y - from.y));
      left = std::min(left, x);
      right = std::max(right, x);
    }
    const int first = std::max(firstSample(left), 0);
    const int last = std::min(firstSample(right), kSampleColumns);
    if (first < last) std::fill_n(samples[static_cast<std::size_t>(row)].begin() + first, last - first, 1);
  }
}

}  // namespace

ShadowGrid silhouette(std::span<const raster::Triangle> triangles, std::span<const Vec2> corners, Vec2 low,
                      Vec2 texel) {
  Samples samples(kSampleRows);
  for (const auto& [a, b, c] : triangles) {
    const auto placed = [&](std::uint32_t corner) { return 2.0F * (corners[corner] - low) / texel; };
    cover({placed(a), placed(b), placed(c)}, samples);
  }
  ShadowGrid grid(kShadowRows);
  for (std::size_t y = 0; y < kShadowRows; ++y) {
    const auto& lower = samples[2 * y];
    const auto& upper = samples[2 * y + 1];
    for (std::size_t x = 0; x < kShadowColumns; ++x) {
      const int sum = lower[2 * x] + lower[2 * x + 1] + upper[2 * x] + upper[2 * x + 1];
      grid[y][x] = 0.25F * static_cast<float>(sum);
    }
  }
  return grid;
}

}  // namespace grove::objects::figure
