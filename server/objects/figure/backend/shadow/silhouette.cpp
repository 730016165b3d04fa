#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "objects/figure/backend/shadow/shadow_grid.h"

namespace grove::objects::figure {
namespace {

using world::Vec2;

constexpr std::size_t kSampleColumns = 2 * kShadowColumns;
constexpr std::size_t kSampleRows = 2 * kShadowRows;

/// For a row of samples, and a column beyond its end: how many more surfaces lie over a sample than over the one before
/// it. Sums may wrap: few surfaces lie over each other.
using Changes = std::array<std::uint8_t, kSampleColumns + 1>;

/// The first sample whose middle is not before a place.
int firstSample(float place) { return static_cast<int>(std::ceil(place - 0.5F)); }

int clampedSample(float place, std::size_t end) { return std::clamp(firstSample(place), 0, static_cast<int>(end)); }

/// Adds an edge of the outline, in samples, counter-clockwise around what it encloses.
void addEdge(Vec2 from, Vec2 to, std::span<Changes> rows) {
  const bool isLeft = to.y < from.y;
  const Vec2 low = isLeft ? to : from;
  const Vec2 high = isLeft ? from : to;
  const auto change = static_cast<std::uint8_t>(isLeft ? 1 : -1);
  const float slope = (high.x - low.x) / std::max(high.y - low.y, 1e-6F);
  const int end = clampedSample(high.y, kSampleRows);
  for (int row = clampedSample(low.y, kSampleRows); row < end; ++row) {
    const float x = low.x + slope * (static_cast<float>(row) + 0.5F - low.y);
    rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(clampedSample(x, kSampleColumns))] += change;
  }
}

bool isFront(const raster::Triangle& triangle, std::span<const Vec2> corners) {
  const Vec2 ab = corners[triangle[1]] - corners[triangle[0]];
  const Vec2 ac = corners[triangle[2]] - corners[triangle[0]];
  return ab.x * ac.y - ab.y * ac.x > 0.0F;
}

/// A closed surface covers with the triangles that face the sun what it covers with all: their edges, without those
/// between two of them.
void addOutline(const ShadowCaster& caster, std::span<const Vec2> corners, std::span<Changes> rows) {
  std::vector<std::uint8_t> fronts(caster.triangles().size());
  for (std::size_t i = 0; i < fronts.size(); ++i) fronts[i] = isFront(caster.triangles()[i], corners) ? 1 : 0;
  for (const raster::SurfaceEdge& edge : caster.edges()) {
    const bool left = fronts[edge.left] != 0;
    const bool right = edge.right != raster::SurfaceEdge::kNone && fronts[edge.right] != 0;
    if (left && !right) addEdge(corners[edge.from], corners[edge.to], rows);
    if (right && !left) addEdge(corners[edge.to], corners[edge.from], rows);
  }
}

/// The shares of the texels of which these are the samples.
ShadowRow sharesOf(const Changes& lower, const Changes& upper) {
  ShadowRow shares;
  std::uint8_t over = 0;  // surfaces over the sample
  std::uint8_t overUpper = 0;
  for (std::size_t x = 0; x < kShadowColumns; ++x) {
    int covered = 0;
    for (const std::size_t column : {2 * x, 2 * x + 1}) {
      over += lower[column];
      overUpper += upper[column];
      covered += (over != 0 ? 1 : 0) + (overUpper != 0 ? 1 : 0);
    }
    shares[x] = 0.25F * static_cast<float>(covered);
  }
  return shares;
}

}  // namespace

ShadowGrid silhouette(const ShadowCaster& caster, std::span<const Vec2> corners, Vec2 low, Vec2 texel) {
  std::vector<Vec2> samples;
  samples.reserve(corners.size());
  for (const Vec2 corner : corners) samples.push_back(2.0F * (corner - low) / texel);
  std::vector<Changes> rows(kSampleRows);
  addOutline(caster, samples, rows);
  ShadowGrid grid(kShadowRows);
  for (std::size_t y = 0; y < kShadowRows; ++y) grid[y] = sharesOf(rows[2 * y], rows[2 * y + 1]);
  return grid;
}

}  // namespace grove::objects::figure
