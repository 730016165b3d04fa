#pragma once

#include <optional>
#include <span>
#include <utility>

namespace grove::measure {

/// A value with its 95 % confidence interval.
struct Estimate {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// y = a + b x.
struct LinearFit {
  Estimate a;
  Estimate b;
  double rSquared = 0.0;  ///< share of the variance of y that the line explains; 1 if y does not vary
  double residual = 0.0;  ///< standard deviation of y around the line

  [[nodiscard]] double at(double x) const noexcept { return a.value + b.value * x; }
};

/// Fits a line by least squares. Returns nothing for fewer than two different x. A line through two points is exact and
/// has no error estimate: the intervals are infinite.
[[nodiscard]] std::optional<LinearFit> linearFit(std::span<const std::pair<double, double>> points);

/// Returns the t that a Student-distributed value with `degrees` (1 or more) degrees of freedom does not exceed in
/// magnitude with probability `confidence`, between 0 and 1.
[[nodiscard]] double studentQuantile(double confidence, int degrees);

}  // namespace grove::measure
