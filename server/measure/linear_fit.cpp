#include "measure/linear_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace grove::measure {
namespace {

constexpr double kConfidence = 0.95;

/// P(|T| <= t) for t = sqrt(degrees) tan(angle): Abramowitz and Stegun, 26.7.3 and 26.7.4.
double within(double angle, int degrees) {
  const double sine = std::sin(angle);
  const double cosine = std::cos(angle);
  const bool odd = degrees % 2 != 0;
  double term = odd ? cosine : 1.0;
  double series = 0.0;
  for (int i = odd ? 1 : 0; i <= degrees - 2; i += 2) {
    series += term;
    term *= cosine * cosine * (i + 1.0) / (i + 2.0);
  }
  return odd ? 2.0 / std::numbers::pi * (angle + sine * series) : sine * series;
}

Estimate around(double value, double reach) { return {value, value - reach, value + reach}; }

}  // namespace

double studentQuantile(double confidence, int degrees) {
  assert(confidence > 0.0 && confidence < 1.0 && degrees >= 1);
  double low = 0.0;
  double high = 0.5 * std::numbers::pi;
  while (true) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return std::sqrt(degrees) * std::tan(low);
    (within(middle, degrees) < confidence ? low : high) = middle;
  }
}

std::optional<LinearFit> linearFit(std::span<const std::pair<double, double>> points) {
  const auto count = static_cast<double>(points.size());
  double meanX = 0.0;
  double meanY = 0.0;
  for (const auto& [x, y] : points) {
    meanX += x / count;
    meanY += y / count;
  }
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (const auto& [x, y] : points) {
    xx += (x - meanX) * (x - meanX);
    xy += (x - meanX) * (y - meanY);
    yy += (y - meanY) * (y - meanY);
  }
  const bool different = std::ranges::any_of(points, [&](const auto& point) { return point.first != points[0].first; });
  if (!different || xx <= 0.0) return std::nullopt;

  const double slope = xy / xx;
  const double offset = meanY - slope * meanX;
  double squares = 0.0;
  for (const auto& [x, y] : points) squares += (y - offset - slope * x) * (y - offset - slope * x);

  LinearFit fit;
  fit.rSquared = yy > 0.0 ? std::max(0.0, 1.0 - squares / yy) : 1.0;
  const int degrees = static_cast<int>(points.size()) - 2;
  double reachB = std::numeric_limits<double>::infinity();
  double reachA = reachB;
  if (degrees > 0) {
    fit.residual = std::sqrt(squares / degrees);
    reachB = studentQuantile(kConfidence, degrees) * fit.residual / std::sqrt(xx);
    reachA = reachB * std::sqrt(xx / count + meanX * meanX);
  }
  fit.a = around(offset, reachA);
  fit.b = around(slope, reachB);
  return fit;
}

}  // namespace grove::measure
