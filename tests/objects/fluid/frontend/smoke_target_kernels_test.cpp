#include "objects/fluid/frontend/smoke_target_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "each_target.h"
#include "objects/fluid/frontend/smoke_scene.h"
#include "objects/fluid/frontend/target_by_hand.h"

namespace grove::objects::fluid::testing {
namespace {

constexpr float kFarthest = 30.0F;
constexpr float kNearest = 2.0F;

/// Ground with low steps, stones and sky: depths jump in some places and not in others.
void placeDepths(Frame& frame) {
  std::mt19937 random(9);
  for (int y = 0; y < frame.image.height(); ++y) {
    for (int x = 0; x < frame.image.width(); ++x) {
      const float ground = (4.0F + 0.05F * static_cast<float>(y)) * (x / 9 % 2 == 0 ? 1.0F : 1.25F);
      const bool stone = x / 13 % 3 == 1 && y / 11 % 2 == 0;
      const bool sky = y < 6;
      frame.image.depthRow(y)[x] = sky     ? world::kInfiniteDepth
                                   : stone ? 1.5F + 0.1F * static_cast<float>(x % 13)
                                           : ground;
      frame.image.colourRow(y)[x] = 0xFF000000U | (random() & 0xFFFFFFU);
    }
  }
}

/// Rects whose ends are no whole blocks, the frame's edges among them.
struct Case {
  int width, height, scale;
  world::Rect rect;
};
const std::array kCases{Case{83, 47, 2, {3, 1, 42, 24}}, Case{83, 47, 4, {0, 0, 21, 12}},
                        Case{131, 33, 2, {0, 2, 66, 17}}, Case{33, 9, 2, {16, 4, 17, 5}},
                        Case{140, 61, 4, {1, 3, 35, 16}}};

TEST(SmokeTargetKernels, DepthsMatchScalarOnEveryTarget) {
  for (const Case& c : kCases) {
    Frame frame(c.width, c.height, kGrey, 0.0F);
    placeDepths(frame);
    tests::onEachTarget([&] {
      Target target(c.rect, c.scale);
      clearPixels(frame.image, kFarthest, target.low.data(), target.high.data(), target.pixels);
      for (int y = 0; y < c.rect.height(); ++y) {
        for (int x = 0; x < c.rect.width(); ++x) {
          const int left = (c.rect.left + x) * c.scale;
          const int top = (c.rect.top + y) * c.scale;
          float nearest = kFarthest;
          float farthest = 0.0F;
          for (int fy = top; fy < std::min(top + c.scale, c.height); ++fy) {
            for (int fx = left; fx < left + c.scale; ++fx) {
              const float depth = std::min(frame.image.depthRow(fy)[std::min(fx, c.width - 1)], kFarthest);
              nearest = std::min(nearest, depth);
              farthest = std::max(farthest, depth);
            }
          }
          const bool odd = (c.rect.left + x + c.rect.top + y) % 2 != 0;
          const SmokeBlock& block = target.block(x, y);
          ASSERT_EQ(block.depth[x % kWidth], odd ? nearest : farthest) << x << ", " << y;
          ASSERT_EQ(block.red[x % kWidth] + block.green[x % kWidth] + block.blue[x % kWidth], 0.0F);
          ASSERT_EQ(block.age[x % kWidth] + block.distance[x % kWidth], 0.0F);
          ASSERT_EQ(block.clear[x % kWidth], 1.0F);
        }
      }
    });
  }
}

/// Random ellipses, some beyond the target's edges.
SmokeSprites randomSprites(std::size_t count, const Case& c) {
  std::mt19937 random(4);
  const auto uniform = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random()) / 4294967296.0F;
  };
  SmokeSprites s;
  s.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    s.x[i] = uniform(-10.0F, static_cast<float>(c.width) + 10.0F);
    s.y[i] = uniform(-10.0F, static_cast<float>(c.height) + 10.0F);
    const float major = uniform(3.0F, 30.0F);
    const float minor = uniform(3.0F, major);
    const float turn = uniform(0.0F, 6.28F);
    const float cosine = std::cos(turn);
    const float sine = std::sin(turn);
    s.xx[i] = cosine * cosine / (major * major) + sine * sine / (minor * minor);
    s.xy[i] = cosine * sine * (1.0F / (major * major) - 1.0F / (minor * minor));
    s.yy[i] = sine * sine / (major * major) + cosine * cosine / (minor * minor);
    s.halfWidth[i] = std::hypot(cosine * major, sine * minor);
    s.halfHeight[i] = std::hypot(sine * major, cosine * minor);
    s.depth[i] = uniform(1.0F, 8.0F);
    s.softness[i] = uniform(0.1F, 0.4F);
    s.opacity[i] = uniform(0.1F, 0.9F);
    s.age[i] = uniform(0.0F, 6.0F);
    s.red[i] = s.opacity[i] * uniform(0.0F, 1.0F);
    s.green[i] = s.opacity[i] * uniform(0.0F, 1.0F);
    s.blue[i] = s.opacity[i] * uniform(0.0F, 1.0F);
  }
  return s;
}

std::vector<std::uint32_t> backwards(std::size_t count) {
  std::vector<std::uint32_t> order(count);
  for (std::size_t i = 0; i < count; ++i) order[i] = static_cast<std::uint32_t>(count - 1 - i);
  return order;
}

/// What drawSprites() says of one pixel: red, green, blue, age, distance, clear.
std::array<double, 6> drawnPlainly(const SmokeSprites& s, const std::vector<std::uint32_t>& order, double x, double y,
                                   double depth) {
  std::array<double, 6> pixel{0.0, 0.0, 0.0, 0.0, 0.0, 1.0};
  for (const std::uint32_t i : order) {
    const double dx = x - static_cast<double>(s.x[i]);
    const double dy = y - static_cast<double>(s.y[i]);
    const double q = static_cast<double>(s.xx[i]) * dx * dx + 2.0 * static_cast<double>(s.xy[i]) * dx * dy +
                     static_cast<double>(s.yy[i]) * dy * dy;
    if (q > 1.0) continue;
    const double free =
        std::clamp((depth - static_cast<double>(s.depth[i])) / static_cast<double>(s.softness[i]), 0.0, 1.0);
    const double weight = (1.0 - q) * (1.0 - q) * free;
    const double keep = 1.0 - weight * static_cast<double>(s.opacity[i]);
    const std::array added{s.red[i], s.green[i], s.blue[i], s.opacity[i] * s.age[i], s.opacity[i] * s.depth[i]};
    for (std::size_t c = 0; c < 5; ++c) pixel[c] = pixel[c] * keep + weight * static_cast<double>(added[c]);
    pixel[5] *= keep;
  }
  return pixel;
}

/// Fails if a target weighs, hides or blends otherwise, leaves out an ellipse's ends, or does not tell which rows it
/// drew into.
TEST(SmokeTargetKernels, EllipsesMatchScalarOnEveryTarget) {
  for (const Case& c : kCases) {
    Frame frame(c.width, c.height, kGrey, 0.0F);
    placeDepths(frame);
    const SmokeSprites sprites = randomSprites(60, c);
    const std::vector<std::uint32_t> order = backwards(sprites.count);
    tests::onEachTarget([&] {
      Target target(c.rect, c.scale);
      clearPixels(frame.image, kFarthest, target.low.data(), target.high.data(), target.pixels);
      drawSprites(sprites, order, target.pixels);
      for (int y = 0; y < c.rect.height(); ++y) {
        for (int x = 0; x < c.rect.width(); ++x) {
          const SmokeBlock& block = target.block(x, y);
          const int lane = x % kWidth;
          const auto expected = drawnPlainly(sprites, order, c.scale * (c.rect.left + x + 0.5),
                                             c.scale * (c.rect.top + y + 0.5), static_cast<double>(block.depth[lane]));
          const std::array drawn{block.red[lane], block.green[lane],    block.blue[lane],
                                 block.age[lane], block.distance[lane], block.clear[lane]};
          for (std::size_t channel = 0; channel < drawn.size(); ++channel) {
            ASSERT_NEAR(static_cast<double>(drawn[channel]), expected[channel], 1e-4) << x << ", " << y;
          }
          const SmokeSpan& span = target.spans[static_cast<std::size_t>(x / kWidth)];
          ASSERT_TRUE(expected[5] > 0.999 || (y >= span.begin && y < span.end)) << x << ", " << y;
        }
      }
    });
  }
}

/// What blendPixels() says of one pixel of the frame.
std::array<double, 3> blendedPlainly(const Target& target, const Frame& frame, int x, int y) {
  const SmokePixels& pixels = target.pixels;
  const world::Rect& rect = pixels.rect;
  const int tx = x / pixels.scale - rect.left;
  const int ty = y / pixels.scale - rect.top;
  const auto atX = [&](int i) { return std::clamp(i, 0, rect.width() - 1); };
  const auto atY = [&](int i) { return std::clamp(i, 0, rect.height() - 1); };
  const auto depthAt = [&](int i, int j) { return target.block(atX(i), atY(j)).depth[atX(i) % kWidth]; };
  float nearest = kFarthest;
  float farthest = 0.0F;
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      nearest = std::min(nearest, depthAt(tx + i, ty + j));
      farthest = std::max(farthest, depthAt(tx + i, ty + j));
    }
  }
  const bool jumps = farthest > 0.5F + 1.08F * nearest;
  const double offX = (x % pixels.scale + 0.5) / pixels.scale - 0.5;
  const double offY = (y % pixels.scale + 0.5) / pixels.scale - 0.5;
  const double own = std::min(frame.image.depthRow(y)[x], kFarthest);
  const std::uint32_t before = frame.image.colourRow(y)[x];
  std::array<double, 3> result{};
  for (std::size_t c = 0; c < 3; ++c) result[c] = before >> (8 * c) & 255U;
  if (jumps && own <= static_cast<double>(kNearest)) return result;
  std::array<double, 4> smoke{};
  double weights = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    const int i = corner % 2 == 0 ? tx : offX < 0.0 ? tx - 1 : tx + 1;
    const int j = corner / 2 == 0 ? ty : offY < 0.0 ? ty - 1 : ty + 1;
    double weight = (corner % 2 == 0 ? 1.0 - std::abs(offX) : std::abs(offX)) *
                    (corner / 2 == 0 ? 1.0 - std::abs(offY) : std::abs(offY));
    const double off = static_cast<double>(depthAt(i, j)) - own;
    if (jumps) weight /= 0.003 + off * off;
    const SmokeBlock& block = target.block(atX(i), atY(j));
    const int lane = atX(i) % kWidth;
    const std::array values{block.red[lane], block.green[lane], block.blue[lane], block.clear[lane]};
    for (std::size_t c = 0; c < 4; ++c) smoke[c] += weight * static_cast<double>(values[c]);
    weights += weight;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    result[c] = std::min(255.0, (result[c] * smoke[3] + 255.0 * smoke[c]) / weights);
    if (!jumps) result[c] = std::floor(result[c] + 0.5);
  }
  return result;
}

/// Fails if a target widens, finds silhouettes or blends otherwise, by more than the rounding to a byte; or if it
/// touches what lies outside.
TEST(SmokeUpsampleKernels, MatchesScalarOnEveryTarget) {
  for (const Case& c : kCases) {
    Frame before(c.width, c.height, kGrey, 0.0F);
    placeDepths(before);
    const SmokeSprites sprites = randomSprites(60, c);
    tests::onEachTarget([&] {
      Target target(c.rect, c.scale);
      clearPixels(before.image, kFarthest, target.low.data(), target.high.data(), target.pixels);
      drawSprites(sprites, backwards(sprites.count), target.pixels);
      // All of it, whether it was drawn into or not.
      for (SmokeSpan& span : target.spans) span = {0, c.rect.height()};
      Frame frame(c.width, c.height, kGrey, 0.0F);
      placeDepths(frame);
      const UpsampleRoom room{target.low.data(),      target.high.data(),  target.line.data(),
                              target.wideRows.data(), target.jumps.data(), target.kept.data()};
      blendPixels(target.pixels, room, kNearest, kFarthest, frame.image);
      for (int y = 0; y < c.height; ++y) {
        for (int x = 0; x < c.width; ++x) {
          const std::uint32_t pixel = frame.image.colourRow(y)[x];
          const bool within = x / c.scale >= c.rect.left && x / c.scale < c.rect.right && y / c.scale >= c.rect.top &&
                              y / c.scale < c.rect.bottom;
          if (!within) {
            ASSERT_EQ(pixel, before.image.colourRow(y)[x]) << x << ", " << y;
            continue;
          }
          const auto expected = blendedPlainly(target, before, x, y);
          ASSERT_EQ(pixel >> 24U, 255U);
          for (std::size_t channel = 0; channel < 3; ++channel) {
            ASSERT_NEAR(pixel >> (8 * channel) & 255U, expected[channel], 1.01) << x << ", " << y;
          }
        }
      }
    });
  }
}

}  // namespace
}  // namespace grove::objects::fluid::testing
