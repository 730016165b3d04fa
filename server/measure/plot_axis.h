#pragma once

#include <vector>

namespace grove::measure {

/// An axis of a plot: maps values to pixels, and selects the ticks.
class PlotAxis {
 public:
  /// Shows at least `low` to `high`, which are positive on a logarithmic axis, at the pixels `from` to `to`.
  PlotAxis(double low, double high, bool logarithmic, double from, double to);

  [[nodiscard]] double pixel(double value) const;
  /// Values, rising; the first and the last are the ends of the axis.
  [[nodiscard]] const std::vector<double>& ticks() const noexcept { return ticks_; }

 private:
  [[nodiscard]] double scaled(double value) const;

  bool logarithmic_;
  double from_, to_;
  std::vector<double> ticks_;
};

}  // namespace grove::measure
