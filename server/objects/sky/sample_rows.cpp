#include "objects/sky/sample_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "world/camera.h"

namespace grove::objects::sky {
namespace {

/// Turns (1 = full circle) from `ahead` to `side`; error below 2e-6. Odd minimax polynomial on 0..1, then octants.
inline float turnsOf(float side, float ahead) {
  const float a = std::fabs(side);
  const float b = std::fabs(ahead);
  const float x = std::min(a, b) / (std::max(a, b) + 1e-20F);
  const float x2 = x * x;
  float angle =
      x * (0.99997726F +
           x2 * (-0.33262347F + x2 * (0.19354346F + x2 * (-0.11643287F + x2 * (0.05265332F + x2 * -0.01172120F)))));
  angle *= 0.5F * std::numbers::inv_pi_v<float>;
  angle = a > b ? 0.25F - angle : angle;
  angle = ahead < 0.0F ? 0.5F - angle : angle;
  return side < 0.0F ? -angle : angle;
}

/// a * (256 - weight) + b * weight of two 8-bit channels in 16-bit lanes; weight is 0..256.
inline std::uint32_t mixPairs(std::uint32_t a, std::uint32_t b, std::uint32_t weight) {
  return ((a * 256U + (b - a) * weight + 0x00800080U) >> 8U) & 0x00FF00FFU;
}

inline std::uint32_t mixTexels(std::uint32_t a, std::uint32_t b, std::uint32_t weight) {
  constexpr std::uint32_t kEven = 0x00FF00FFU;
  return mixPairs(a & kEven, b & kEven, weight) | mixPairs((a >> 8U) & kEven, (b >> 8U) & kEven, weight) << 8U;
}

constexpr int kKnot = 16;      // samples between those whose place is worked out
constexpr int kChunk = 256;    // samples that are worked on together
constexpr float kBend = 0.6F;  // texels that a row's path through the panorama may bend between knots

/// Places in the panorama, in texels. Columns may lie up to a turn beyond the width.
struct Places {
  alignas(64) std::array<float, kChunk + kKnot> x;
  alignas(64) std::array<float, kChunk + kKnot> y;
};

/// The first `count` of the samples from `first` on, `apart` from each other. Rounded up to whole vectors.
void aim(const Panorama& panorama, const RowOfRays& row, int first, int apart, int count, Places& out) {
  const auto width = static_cast<float>(panorama.width());
  const auto height = static_cast<float>(panorama.height() - 1);
  const float sideStep = row.sideStep * static_cast<float>(apart);
  const float firstSide = row.firstSide + row.sideStep * static_cast<float>(first);
  const float ahead = row.ahead;
  const float up = row.up;
  // A row's left end is up to half a turn away.
  const float left = -row.yaw * 0.5F * std::numbers::inv_pi_v<float> - 0.5F;
  const float turned = left - std::floor(left) + 0.5F;
  float* __restrict xs = out.x.data();
  float* __restrict ys = out.y.data();
  for (int i = 0; i < (count + kKnot - 1) / kKnot * kKnot; ++i) {
    const float side = firstSide + static_cast<float>(i) * sideStep;
    const float across = std::sqrt(side * side + ahead * ahead);
    const float above = std::max(0.0F, up + Panorama::kBelow * across);
    xs[i] = (turnsOf(side, ahead) + turned) * width;
    ys[i] = above / (above + Panorama::kSpread * across) * height;
  }
}

/// Straight from each knot to the next.
void joinKnots(const Places& knots, Places& out) {
  for (int knot = 0; knot < kChunk / kKnot; ++knot) {
    const auto at = static_cast<std::size_t>(knot);
    const float x = knots.x[at];
    const float y = knots.y[at];
    const float xStep = (knots.x[at + 1] - x) * (1.0F / kKnot);
    const float yStep = (knots.y[at + 1] - y) * (1.0F / kKnot);
    float* __restrict xs = out.x.data() + knot * kKnot;
    float* __restrict ys = out.y.data() + knot * kKnot;
    for (int i = 0; i < kKnot; ++i) {
      xs[i] = x + static_cast<float>(i) * xStep;
      ys[i] = y + static_cast<float>(i) * yStep;
    }
  }
}

/// Whether a row's path may be joined from knots: the heading bends most where the ray is nearest to the zenith.
bool nearlyStraight(const Panorama& panorama, const RowOfRays& row) {
  constexpr float kMostBend = 0.65F / 8.0F;  // of the arc tangent, by the square of a step
  const float step = kKnot * row.sideStep;
  const float texels = static_cast<float>(panorama.width()) * 0.5F * std::numbers::inv_pi_v<float>;
  return row.ahead > 0.0F && kMostBend * step * step * texels < kBend * row.ahead * row.ahead;
}

/// A texel and the next, looked up as one.
using Neighbours [[gnu::may_alias, gnu::aligned(4)]] = std::uint64_t;

void lookUp(const Panorama& panorama, const Places& places, int begin, int end, std::uint32_t* __restrict colour) {
  const std::uint32_t* __restrict texels = panorama.texels();
  const float* __restrict xs = places.x.data() + begin;
  const float* __restrict ys = places.y.data() + begin;
  const int stride = panorama.stride();
  const int width = panorama.width();
  const int last = (panorama.height() - 2) * 256 + 255;
  for (int i = 0; i < end - begin; ++i) {
    const int x = static_cast<int>(xs[i] * 256.0F);
    const int y = std::min(static_cast<int>(ys[i] * 256.0F), last);
    const int turned = x >> 8;
    const int column = std::min(turned >= width ? turned - width : turned, width - 1);
    const auto xWeight = static_cast<std::uint32_t>(x & 255);
    const auto yWeight = static_cast<std::uint32_t>(y & 255);
    const int at = (y >> 8) * stride + column;
    const std::uint64_t below = *reinterpret_cast<const Neighbours*>(texels + at);
    const std::uint64_t above = *reinterpret_cast<const Neighbours*>(texels + at + stride);
    const std::uint32_t low =
        mixTexels(static_cast<std::uint32_t>(below), static_cast<std::uint32_t>(below >> 32U), xWeight);
    const std::uint32_t high =
        mixTexels(static_cast<std::uint32_t>(above), static_cast<std::uint32_t>(above >> 32U), xWeight);
    colour[i] = mixTexels(low, high, yWeight) | 0xFF000000U;
  }
}

}  // namespace

void sampleRow(const Panorama& panorama, const RowOfRays& rays, int first, int count, std::uint32_t* colour) {
  const bool straight = nearlyStraight(panorama, rays);
  Places knots;
  Places places;
  for (int chunk = first / kChunk * kChunk; chunk < first + count; chunk += kChunk) {
    if (straight) {
      aim(panorama, rays, chunk, kKnot, kChunk / kKnot + 1, knots);
      joinKnots(knots, places);
    } else {
      aim(panorama, rays, chunk, 1, kChunk, places);
    }
    const int begin = std::max(first, chunk);
    const int end = std::min(first + count, chunk + kChunk);
    lookUp(panorama, places, begin - chunk, end - chunk, colour + (begin - first));
  }
}

namespace {

template <unsigned kStep>
void widen(const std::uint32_t* __restrict above, const std::uint32_t* __restrict below, int count,
           std::uint32_t* __restrict colour) {
  const int steps = (count + static_cast<int>(kStep) - 1) / static_cast<int>(kStep);
  for (int i = 0; i < steps; ++i) {
    const std::uint32_t left = mixTexels(above[i], below[i], 128U);
    const std::uint32_t right = mixTexels(above[i + 1], below[i + 1], 128U);
    std::uint32_t* __restrict out = colour + i * static_cast<int>(kStep);
    out[0] = left;
    for (unsigned j = 1; j < kStep; ++j) out[j] = mixTexels(left, right, 256U / kStep * j);
  }
}

}  // namespace

void widenRow(const std::uint32_t* above, const std::uint32_t* below, int step, int count, std::uint32_t* colour) {
  if (step == 2) {
    widen<2>(above, below, count, colour);
  } else {
    widen<4>(above, below, count, colour);
  }
}

void fillDepth(int count, float* depth) {
  for (int i = 0; i < count; ++i) depth[i] = world::kInfiniteDepth;
}

}  // namespace grove::objects::sky
