#include "objects/sky/sample_rows.h"

#include <algorithm>
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

/// Both of a and b hold two 8-bit channels in 16-bit lanes; weight is 0..256.
inline std::uint32_t mixPairs(std::uint32_t a, std::uint32_t b, std::uint32_t weight) {
  return ((a * (256U - weight) + b * weight + 0x00800080U) >> 8U) & 0x00FF00FFU;
}

inline std::uint32_t mixTexels(std::uint32_t a, std::uint32_t b, std::uint32_t weight) {
  constexpr std::uint32_t kEven = 0x00FF00FFU;
  return mixPairs(a & kEven, b & kEven, weight) | mixPairs((a >> 8U) & kEven, (b >> 8U) & kEven, weight) << 8U;
}

}  // namespace

void sampleRow(const Panorama& panorama, const RowOfRays& rays, int count, std::uint32_t* __restrict colour) {
  const std::uint32_t* __restrict texels = panorama.texels();
  const int stride = panorama.stride();
  const int lastColumn = panorama.width() - 1;
  const int lastRow = panorama.height() - 2;
  const auto width = static_cast<float>(panorama.width());
  const auto height = static_cast<float>(panorama.height() - 1);
  const float yawTurns = -rays.yaw * 0.5F * std::numbers::inv_pi_v<float>;
  const RowOfRays row = rays;
  for (int i = 0; i < count; ++i) {
    const float side = row.firstSide + static_cast<float>(i) * row.sideStep;
    const float across = std::sqrt(side * side + row.ahead * row.ahead);
    const float above = std::max(0.0F, row.up + Panorama::kBelow * across);
    const float turns = turnsOf(side, row.ahead) + yawTurns;
    const float x = (turns - std::floor(turns)) * width;
    const float y = above / (above + Panorama::kSpread * across) * height;
    const int column = std::min(static_cast<int>(x), lastColumn);
    const int line = std::min(static_cast<int>(y), lastRow);
    const auto xWeight = static_cast<std::uint32_t>(static_cast<int>((x - static_cast<float>(column)) * 256.0F));
    const auto yWeight = static_cast<std::uint32_t>(static_cast<int>((y - static_cast<float>(line)) * 256.0F));
    const int at = line * stride + column;
    const std::uint32_t low = mixTexels(texels[at], texels[at + 1], xWeight);
    const std::uint32_t high = mixTexels(texels[at + stride], texels[at + stride + 1], xWeight);
    colour[i] = mixTexels(low, high, yWeight) | 0xFF000000U;
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
