#include "measure/linear_fit.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cassert>
#include <cmath>
#include <limits>

namespace grove::measure {
namespace {

constexpr double kConfidence = 0.95;

Estimate around(double value, double reach) { return {value, value - reach, value + reach}; }

}  // namespace

double studentQuantile(double confidence, int degrees) {
  assert(confidence > 0.0 && confidence < 1.0 && degrees >= 1);
  return boost::math::quantile(boost::math::students_t(degrees), 0.5 + 0.5 * confidence);
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
