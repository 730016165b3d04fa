#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "objects/figure/backend/shadow/shadow_grid.h"

namespace grove::objects::figure {
namespace {

using world::Vec2;

constexpr int kSampleColumns = 2 * kShadowColumns;
constexpr int kSampleRows = 2 * kShadowRows;
using Word = std::uint64_t;
constexpr int kWord = 64;
/// One bit for each sample of a row.
using SampleRow = std::array<Word, kSampleColumns / kWord>;

/// The first sample whose middle is not before a place.
int firstSample(float place) { return static_cast<int>(std::ceil(place - 0.5F)); }

/// The lowest `count` bits, at least 0 and at most all.
Word lowest(int count) { return count <= 0 ? 0 : ~Word{0} >> (kWord - std::min(count, kWord)); }

/// Sets the samples from `first` to before `end`.
void set(SampleRow& row, int first, int end) {
  int begin = 0;
  for (Word& word : row) {
    word |= lowest(end - begin) & ~lowest(first - begin);
    begin += kWord;
  }
}

/// From one of the ends of a side to the other, upwards.
struct Side {
  Vec2 from;
  Vec2 to;
  float slope;  ///< across, per unit upwards

  Side(Vec2 a, Vec2 b)
      : from(a.y <= b.y ? a : b), to(a.y <= b.y ? b : a), slope((to.x - from.x) / std::max(to.y - from.y, 1e-6F)) {}
};

/// `corners` are in samples. A closed surface covers with the triangles that face the sun what it covers with all.
void cover(const std::array<Vec2, 3>& corners, std::span<SampleRow> samples) {
  const Vec2 ab = corners[1] - corners[0];
  const Vec2 ac = corners[2] - corners[0];
  if (ab.x * ac.y - ab.y * ac.x <= 0.0F) return;
  const std::array<Side, 3> sides{{{corners[0], corners[1]}, {corners[1], corners[2]}, {corners[2], corners[0]}}};
  const auto [bottom, top] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
  const int end = std::min(firstSample(top), kSampleRows);
  for (int row = std::max(firstSample(bottom), 0); row < end; ++row) {
    const float y = static_cast<float>(row) + 0.5F;
    float left = static_cast<float>(kSampleColumns);
    float right = 0.0F;
    for (const Side& side : sides) {
      if (y < side.from.y || y >= side.to.y) continue;
      const float x = side.from.x + side.slope * (y - side.from.y);
      left = std::min(left, x);
      right = std::max(right, x);
    }
    const int first = std::max(firstSample(left), 0);
    const int last = std::min(firstSample(right), kSampleColumns);
    if (first < last) set(samples[static_cast<std::size_t>(row)], first, last);
  }
}

/// The number of samples that are set in two columns of a row.
int countOf(const SampleRow& row, std::size_t column) {
  constexpr std::size_t kTexels = kWord / 2;
  return std::popcount(row[column / kTexels] >> (2 * (column % kTexels)) & 3U);
}

}  // namespace

ShadowGrid silhouette(std::span<const raster::Triangle> triangles, std::span<const Vec2> corners, Vec2 low,
                      Vec2 texel) {
  std::array<SampleRow, kSampleRows> samples{};
  for (const auto& [a, b, c] : triangles) {
    const auto placed = [&](std::uint32_t corner) { return 2.0F * (corners[corner] - low) / texel; };
    cover({placed(a), placed(b), placed(c)}, samples);
  }
  ShadowGrid grid(kShadowRows);
  for (std::size_t y = 0; y < kShadowRows; ++y) {
    for (std::size_t x = 0; x < kShadowColumns; ++x) {
      grid[y][x] = 0.25F * static_cast<float>(countOf(samples[2 * y], x) + countOf(samples[2 * y + 1], x));
    }
  }
  return grid;
}

}  // namespace grove::objects::figure
