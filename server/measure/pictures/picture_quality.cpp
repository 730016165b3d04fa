#include "measure/pictures/picture_quality.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace grove::measure {
namespace {

constexpr int kReach = 5;
constexpr double kSpread = 1.5;
constexpr double kC1 = 0.01 * 255.0 * 0.01 * 255.0;
constexpr double kC2 = 0.03 * 255.0 * 0.03 * 255.0;

using Plane = std::vector<float>;

double channel(std::uint32_t pixel, unsigned shift) { return static_cast<double>((pixel >> shift) & 0xFFU); }

Plane luma(const Picture& picture) {
  Plane plane(picture.colour.size());
  std::ranges::transform(picture.colour, plane.begin(), [](std::uint32_t p) {
    return static_cast<float>(lumaOf(channel(p, 0), channel(p, 8), channel(p, 16)));
  });
  return plane;
}

Plane product(const Plane& a, const Plane& b) {
  Plane result(a.size());
  std::ranges::transform(a, b, result.begin(), [](float x, float y) { return x * y; });
  return result;
}

std::array<float, 2 * kReach + 1> gaussian() {
  std::array<float, 2 * kReach + 1> weights{};
  double total = 0.0;
  const auto at = [](int i) { return std::exp(-0.5 * i * i / (kSpread * kSpread)); };
  for (int i = -kReach; i <= kReach; ++i) total += at(i);
  for (int i = -kReach; i <= kReach; ++i) {
    weights[static_cast<std::size_t>(std::ptrdiff_t{i} + kReach)] = static_cast<float>(at(i) / total);
  }
  return weights;
}

/// Blurs along one direction: `step` from a pixel to the next, `count` pixels, `lines` lines that are `lineStep` apart.
Plane blurredAlong(const Plane& from, int count, int step, int lines, int lineStep) {
  const auto weights = gaussian();
  Plane to(from.size());
  for (int line = 0; line < lines; ++line) {
    const std::ptrdiff_t start = std::ptrdiff_t{line} * lineStep;
    for (int i = 0; i < count; ++i) {
      float sum = 0.0F;
      float total = 0.0F;
      for (int k = std::max(-kReach, -i); k <= std::min(kReach, count - 1 - i); ++k) {
        const float weight = weights[static_cast<std::size_t>(std::ptrdiff_t{k} + kReach)];
        sum += weight * from[static_cast<std::size_t>(start + std::ptrdiff_t{i + k} * step)];
        total += weight;
      }
      to[static_cast<std::size_t>(start + std::ptrdiff_t{i} * step)] = sum / total;
    }
  }
  return to;
}

Plane blurred(const Plane& plane, const Picture& shape) {
  const int width = shape.width;
  const int height = shape.height();
  return blurredAlong(blurredAlong(plane, width, 1, height, width), height, width, width, 1);
}

}  // namespace

Mask covered(const Picture& picture) {
  Mask mask(picture.colour.size());
  std::ranges::transform(picture.colour, mask.begin(),
                         [](std::uint32_t pixel) { return static_cast<std::uint8_t>(pixel >> 24U != 0); });
  return mask;
}

double meanSquareError(const Picture& a, const Picture& b, const Mask& mask) {
  assert(a.colour.size() == b.colour.size() && a.colour.size() == mask.size());
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] == 0) continue;
    for (const unsigned shift : {0U, 8U, 16U}) {
      const double error = channel(a.colour[i], shift) - channel(b.colour[i], shift);
      sum += error * error;
    }
    count += 3.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

double decibels(double meanSquareError) {
  if (meanSquareError <= 0.0) return kEqual;
  return std::min(kEqual, 10.0 * std::log10(255.0 * 255.0 / meanSquareError));
}

double structuralSimilarity(const Picture& a, const Picture& b, const Mask& mask) {
  assert(a.width == b.width && a.colour.size() == b.colour.size() && a.colour.size() == mask.size());
  const Plane lumaA = luma(a);
  const Plane lumaB = luma(b);
  const Plane meanA = blurred(lumaA, a);
  const Plane meanB = blurred(lumaB, a);
  const Plane squareA = blurred(product(lumaA, lumaA), a);
  const Plane squareB = blurred(product(lumaB, lumaB), a);
  const Plane both = blurred(product(lumaA, lumaB), a);
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] == 0) continue;
    const double x = static_cast<double>(meanA[i]);
    const double y = static_cast<double>(meanB[i]);
    const double xx = static_cast<double>(squareA[i]) - x * x;
    const double yy = static_cast<double>(squareB[i]) - y * y;
    const double xy = static_cast<double>(both[i]) - x * y;
    sum += (2.0 * x * y + kC1) * (2.0 * xy + kC2) / ((x * x + y * y + kC1) * (xx + yy + kC2));
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 1.0;
}

}  // namespace grove::measure
