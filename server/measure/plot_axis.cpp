#include "measure/plot_axis.h"

#include <algorithm>
#include <cmath>

namespace grove::measure {
namespace {

/// Places about five ticks at multiples of 1, 2 or 5 times a power of ten; begins at zero if that wastes little.
std::vector<double> evenTicks(double low, double high) {
  if (low >= 0.0 && low <= 0.6 * high) low = 0.0;
  if (high <= low) {
    const double room = low != 0.0 ? 0.1 * std::abs(low) : 1.0;
    low -= room;
    high += room;
  }
  const double rough = (high - low) / 5.0;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double multiple : {5.0, 2.0, 1.0}) {
    if (multiple * power >= rough) step = multiple * power;
  }
  const auto first = std::lround(std::floor(low / step + 1e-9));
  const auto last = std::lround(std::ceil(high / step - 1e-9));
  std::vector<double> ticks;
  for (auto i = first; i <= last; ++i) ticks.push_back(static_cast<double>(i) * step);
  return ticks;
}

/// Places ticks at powers of ten; with few decades also at 2 and 5 times them, with many only at every few.
std::vector<double> decadeTicks(double low, double high) {
  const double decades = std::log10(high / low);
  const auto every = std::max(1L, std::lround(std::ceil(decades / 6.0)));
  const std::vector<double> multiples = decades < 3.0 ? std::vector{1.0, 2.0, 5.0} : std::vector{1.0};
  std::vector<double> all;
  const auto end = std::lround(std::ceil(std::log10(high))) + every;
  for (auto power = std::lround(std::floor(std::log10(low))); power <= end; power += every) {
    for (const double multiple : multiples) all.push_back(multiple * std::pow(10.0, static_cast<double>(power)));
  }
  const double slack = 1e-9;
  const auto first = std::ranges::upper_bound(all, low * (1.0 + slack)) - 1;
  auto last = std::ranges::lower_bound(all, high * (1.0 - slack));
  if (last <= first) last = first + 1;
  return {first, last + 1};
}

}  // namespace

PlotAxis::PlotAxis(double low, double high, bool logarithmic, double from, double to)
    : logarithmic_(logarithmic),
      from_(from),
      to_(to),
      ticks_(logarithmic ? decadeTicks(low, high) : evenTicks(low, high)) {}

double PlotAxis::pixel(double value) const {
  const double low = scaled(ticks_.front());
  return from_ + (scaled(value) - low) / (scaled(ticks_.back()) - low) * (to_ - from_);
}

double PlotAxis::scaled(double value) const { return logarithmic_ ? std::log10(value) : value; }

}  // namespace grove::measure
