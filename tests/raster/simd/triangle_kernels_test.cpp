#include "raster/simd/triangle_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "each_target.h"

namespace grove::raster {
namespace {

constexpr int kTargetSize = 200;
constexpr world::Rect kTarget{0, 0, kTargetSize, kTargetSize};

Corner halfDeepAt(float x, float y) { return {x, y, {0.5F, 0, 0, 0, 0, 0}}; }

/// Draws the triangle's front, whichever way it turns, on an empty canvas.
void drawAlone(const std::array<Corner, 3>& corners, Canvas& canvas) {
  const auto& [a, b, c] = corners;
  const bool turned = (b.x - a.x) * (c.y - a.y) > (c.x - a.x) * (b.y - a.y);
  canvas.begin(canvas.rect);
  drawTriangles(std::vector<Triangle>{turned ? Triangle{0, 2, 1} : Triangle{0, 1, 2}}, corners, canvas);
}

std::size_t indexOf(const Canvas& canvas, int x, int y) {
  return static_cast<std::size_t>((y - canvas.rect.top) * canvas.stride + x - canvas.rect.left);
}

/// How often each pixel is hit by triangles.
class Hits {
 public:
  Hits() { canvas_.rect = kTarget; }

  void add(const std::array<Corner, 3>& corners) {
    drawAlone(corners, canvas_);
    for (int y = 0; y < kTargetSize; ++y) {
      const Span span = canvas_.spans[static_cast<std::size_t>(y)];
      for (int x = span.begin; x < span.end; ++x) {
        if (canvas_.depth[indexOf(canvas_, x, y)] > 0.0F) ++count_[at(x, y)];
      }
    }
  }

  [[nodiscard]] int of(int x, int y) const { return count_[at(x, y)]; }

 private:
  static std::size_t at(int x, int y) { return static_cast<std::size_t>(y * kTargetSize + x); }
  Canvas canvas_;
  std::vector<int> count_ = std::vector<int>(std::size_t{kTargetSize} * kTargetSize);
};

/// Where an edge crosses the middle of a row, each step rounded to floats and no two together: the product of two
/// floats fits into a double.
float crossing(const Corner& from, const Corner& to, int row) {
  const Corner& upper = from.y < to.y ? from : to;
  const Corner& lower = from.y < to.y ? to : from;
  const float slope = (lower.x - upper.x) / (lower.y - upper.y);
  const double along = static_cast<double>(static_cast<float>(row) + 0.5F - upper.y) * static_cast<double>(slope);
  return upper.x + static_cast<float>(along);
}

/// The columns whose middle lies between the crossings of the triangle's edges.
Span plainSpan(const std::array<Corner, 3>& corners, int row) {
  const float middle = static_cast<float>(row) + 0.5F;
  std::vector<float> crossings;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner& from = corners[i];
    const Corner& to = corners[(i + 1) % 3];
    if (std::min(from.y, to.y) <= middle && middle < std::max(from.y, to.y)) {
      crossings.push_back(crossing(from, to, row));
    }
  }
  if (crossings.empty()) return {};
  const auto column = [](float x) {
    return static_cast<int>(std::ceil(std::clamp(x - 0.5F, 0.0F, float{kTargetSize})));
  };
  return {column(std::ranges::min(crossings)), column(std::ranges::max(crossings))};
}

float onGrid(float pixels) { return std::floor(pixels / kSubPixel) * kSubPixel; }

TEST(TriangleKernels, PixelsBelongByTheirCentre) {
  tests::onEachTarget([] {
    Hits hits;
    hits.add({halfDeepAt(10, 10), halfDeepAt(20, 10), halfDeepAt(10, 20)});
    int all = 0;
    for (int y = 0; y < kTargetSize; ++y) {
      for (int x = 0; x < kTargetSize; ++x) {
        all += hits.of(x, y);
        // The slanting edge is the right one, whose pixels are not the triangle's.
        const bool inside = x >= 10 && y >= 10 && (x - 10) + (y - 10) + 1 < 10;
        ASSERT_EQ(hits.of(x, y), inside ? 1 : 0) << x << ", " << y;
      }
    }
    EXPECT_EQ(all, 45);
  });
}

/// Fails if a target fuses or rearranges the arithmetic of an edge, or leaves rows or columns out: each must be cut as
/// it is here, to the last bit.
TEST(TriangleKernels, EdgesAreIdenticalOnEveryTarget) {
  tests::onEachTarget([] {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> anywhere(-40.0F, kTargetSize + 40.0F);
    std::uniform_real_distribution<float> close(-9.0F, 9.0F);
    std::uniform_int_distribution<int> centre(-12, 12);
    Canvas canvas;
    canvas.rect = kTarget;
    int pixels = 0;
    for (int i = 0; i < 3000; ++i) {
      std::array<Corner, 3> corners{};
      const float x = anywhere(random);
      const float y = anywhere(random);
      for (Corner& corner : corners) {
        corner = i % 4 == 0 ? halfDeepAt(onGrid(anywhere(random)), onGrid(anywhere(random)))
                            : halfDeepAt(onGrid(x + close(random)), onGrid(y + close(random)));
        // Edges from centre to centre pass through others', and near column 0 floats tell how the sum was rounded.
        if (i % 4 == 1) {
          corner = halfDeepAt(0.5F + static_cast<float>(centre(random)), 12.5F + static_cast<float>(centre(random)));
        }
      }
      drawAlone(corners, canvas);
      for (int row = 0; row < kTargetSize; ++row) {
        const Span found = canvas.spans[static_cast<std::size_t>(row)];
        const Span expected = plainSpan(corners, row);
        if (expected.begin >= expected.end) {
          ASSERT_GE(found.begin, found.end) << "triangle " << i << ", row " << row;
          continue;
        }
        ASSERT_EQ(found.begin, expected.begin) << "triangle " << i << ", row " << row;
        ASSERT_EQ(found.end, expected.end) << "triangle " << i << ", row " << row;
        for (int column = 0; column < canvas.stride; ++column) {
          const bool inside = column >= expected.begin && column < expected.end;
          ASSERT_EQ(canvas.depth[indexOf(canvas, column, row)], inside ? 0.5F : 0.0F)
              << "triangle " << i << " at " << column << ", " << row;
        }
        pixels += expected.end - expected.begin;
      }
    }
    EXPECT_GT(pixels, 1000000);
  });
}

TEST(TriangleKernels, FanCoversEachPixelOnce) {
  tests::onEachTarget([] {
    for (int turn = 0; turn < 40; ++turn) {
      Hits hits;
      const float phase = 0.157F * static_cast<float>(turn);
      const Corner centre = halfDeepAt(100.0F + 0.25F * static_cast<float>(turn % 4), 100.5F);
      const auto rim = [&](int i) {
        const float angle = phase + 6.2831853F * static_cast<float>(i % 23) / 23.0F;
        return halfDeepAt(centre.x + 70.0F * std::cos(angle), centre.y + 70.0F * std::sin(angle));
      };
      for (int i = 0; i < 23; ++i) hits.add({centre, rim(i), rim(i + 1)});
      for (int y = 0; y < kTargetSize; ++y) {
        for (int x = 0; x < kTargetSize; ++x) {
          const float out =
              std::hypot(static_cast<float>(x) + 0.5F - centre.x, static_cast<float>(y) + 0.5F - centre.y);
          const int min = out < 68.0F ? 1 : 0;
          const int max = out > 71.0F ? 0 : 1;
          ASSERT_GE(hits.of(x, y), min) << x << ", " << y << " turn " << turn;
          ASSERT_LE(hits.of(x, y), max) << x << ", " << y << " turn " << turn;
        }
      }
    }
  });
}

/// Fails if a target interpolates a plane otherwise or packs it elsewhere; bytes may be off by one where they round.
TEST(TriangleKernels, InterpolationIsPerspectiveCorrectOnEveryTarget) {
  tests::onEachTarget([] {
    constexpr world::Rect kRect{7, 5, 7 + 61, 5 + 45};
    const std::array<ClipVertex, 3> vertices = {ClipVertex{9.0F, 6.0F, 1.0F, {250, 10, 90, 15, 0}},
                                                {16.0F, 190.0F, 4.0F, {20, 240, 30, 2, 14}},
                                                {130.0F, 40.0F, 2.0F, {0, 100, 255, 7, 3}}};
    std::array<Corner, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) corners[i] = projected(vertices[i], 0.1F);
    Canvas canvas;
    canvas.rect = kRect;
    drawAlone(corners, canvas);
    const Corner& a = corners[0];
    const Corner& b = corners[1];
    const Corner& c = corners[2];
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    int covered = 0;
    for (int y = kRect.top; y < kRect.bottom; ++y) {
      for (int x = kRect.left; x < kRect.right; ++x) {
        const float depth = canvas.depth[indexOf(canvas, x, y)];
        if (depth == 0.0F) continue;
        ++covered;
        const double px = x + 0.5;
        const double py = y + 0.5;
        const double atB = ((px - a.x) * (c.y - a.y) - (c.x - a.x) * (py - a.y)) / area;
        const double atC = ((b.x - a.x) * (py - a.y) - (px - a.x) * (b.y - a.y)) / area;
        const auto plane = [&](std::size_t k) {
          return a.planes[k] + atB * (b.planes[k] - a.planes[k]) + atC * (c.planes[k] - a.planes[k]);
        };
        ASSERT_NEAR(depth, plane(0), 1.0e-6) << x << ", " << y;
        const std::uint32_t found = canvas.surface[indexOf(canvas, x, y)];
        const std::array<std::uint32_t, 5> shades = {found & 0xFFU, found >> 8U & 0xFFU, found >> 16U & 0xFFU,
                                                     found >> 28U, found >> 24U & 0xFU};
        for (std::size_t k = 0; k < shades.size(); ++k) {
          ASSERT_NEAR(shades[k], plane(k + 1) / plane(0), 0.51) << "shade " << k << " at " << x << ", " << y;
        }
      }
    }
    EXPECT_GT(covered, 1000);
  });
}

}  // namespace
}  // namespace grove::raster
