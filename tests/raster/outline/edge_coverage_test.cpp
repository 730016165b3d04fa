#include "raster/outline/edge_coverage.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace grove::raster {
namespace {

using world::Vec2;

using Polygon = std::vector<Vec2>;

constexpr world::Rect kPart{5, -3, 45, 27};

float cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

/// Counter-clockwise as seen, on a screen whose y grows downwards.
Polygon triangle(Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - a) < 0.0F ? Polygon{a, b, c} : Polygon{a, c, b}; }

bool contains(const Polygon& polygon, Vec2 point) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 from = polygon[i];
    if (cross(polygon[(i + 1) % polygon.size()] - from, point - from) > 0.0F) return false;
  }
  return true;
}

/// Share of a pixel by 64 x 64 samples.
float sampled(const Polygon& polygon, int x, int y) {
  constexpr int kSamples = 64;
  int inside = 0;
  for (int row = 0; row < kSamples; ++row) {
    for (int column = 0; column < kSamples; ++column) {
      const Vec2 step = (Vec2(column, row) + 0.5F) / static_cast<float>(kSamples);
      if (contains(polygon, Vec2(x, y) + step)) ++inside;
    }
  }
  return static_cast<float>(inside) / (kSamples * kSamples);
}

void add(EdgeCoverage& coverage, const Polygon& polygon) {
  for (std::size_t i = 0; i < polygon.size(); ++i) coverage.add(polygon[i], polygon[(i + 1) % polygon.size()]);
}

std::map<std::pair<int, int>, float> sharesOf(EdgeCoverage& coverage) {
  std::map<std::pair<int, int>, float> shares;
  for (const CoveredPixels& pixels : coverage.partly()) {
    for (int x = pixels.begin; x < pixels.end; ++x) shares[{kPart.left + x, kPart.top + pixels.row}] = pixels.share;
  }
  return shares;
}

/// Fails if an edge's part of a pixel is wrong, or what is clipped at a side of the rectangle.
TEST(EdgeCoverage, SharesAreThoseOfManySamples) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-20.0F, 60.0F);
  EdgeCoverage coverage;
  for (int trial = 0; trial < 40; ++trial) {
    const auto point = [&] { return Vec2(place(random), place(random)); };
    const Vec2 a = point();
    const Vec2 b = point();
    const Polygon polygon = triangle(a, b, point());
    coverage.begin(kPart);
    add(coverage, polygon);
    const auto shares = sharesOf(coverage);
    for (int y = kPart.top; y < kPart.bottom; ++y) {
      for (int x = kPart.left; x < kPart.right; ++x) {
        const float expected = sampled(polygon, x, y);
        const auto found = shares.find({x, y});
        // What is not reported is inside or outside as a whole.
        const float share = found == shares.end() ? std::round(expected) : found->second;
        ASSERT_NEAR(share, expected, 0.012F) << x << ", " << y << " trial " << trial;
      }
    }
  }
}

/// Fails if rounding leaves a seam between two polygons.
TEST(EdgeCoverage, ACommonEdgeIsNoEdge) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-0.4F, 0.4F);
  EdgeCoverage coverage;
  for (int trial = 0; trial < 40; ++trial) {
    const auto near = [&](float x, float y) { return Vec2(x + 30.0F * place(random), y + 20.0F * place(random)); };
    const std::array corners{Vec2(-90, -90), Vec2(140, -90), Vec2(140, 130), Vec2(-90, 130)};
    const Vec2 middle = near(25, 12);
    coverage.begin(kPart);
    for (std::size_t i = 0; i < 4; ++i) add(coverage, triangle(corners[i], corners[(i + 1) % 4], middle));
    EXPECT_TRUE(coverage.partly().empty()) << trial;
  }
}

/// Fails if a pixel that two polygons cover counts as covered in part.
TEST(EdgeCoverage, OverlapsAddUp) {
  EdgeCoverage coverage;
  coverage.begin(kPart);
  add(coverage, {{10, 0}, {10, 20}, {30.25F, 20}, {30.25F, 0}});
  add(coverage, {{20.5F, 0}, {20.5F, 20}, {40, 20}, {40, 0}});
  EXPECT_TRUE(coverage.partly().empty());
}

TEST(EdgeCoverage, ARowThatIsCoveredInPartIsOneRun) {
  EdgeCoverage coverage;
  coverage.begin(kPart);
  add(coverage, {{10, 4.25F}, {10, 8}, {30, 8}, {30, 4.25F}});
  ASSERT_EQ(coverage.partly().size(), 2U);  // a pixel beside the edge, and the others
  for (const CoveredPixels& pixels : coverage.partly()) {
    EXPECT_EQ(pixels.row, 7);
    EXPECT_NEAR(pixels.share, 0.75F, 1.0e-5F);
  }
  EXPECT_EQ(coverage.partly().back().end, 25);
}

/// Fails if a number that is no place on the screen is used as one.
TEST(EdgeCoverage, PlacesFarOutsideAreClipped) {
  EdgeCoverage coverage;
  coverage.begin(kPart);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  add(coverage, {{-1.0e30F, -1.0e30F}, {-1.0e30F, 1.0e30F}, {1.0e30F, 1.0e30F}, {1.0e30F, -1.0e30F}});
  coverage.add({nan, 3}, {nan, 9});
  coverage.add({3, nan}, {9, nan});
  EXPECT_TRUE(coverage.partly().empty());
}

}  // namespace
}  // namespace grove::raster
