#include "stream/adapt/frame_times.h"

#include <algorithm>
#include <cmath>

#include "stream/protocol/saturate.h"

namespace grove::stream {
namespace {

constexpr double kPeriodSeconds = 1.0;
constexpr double kTenthsOfMilliseconds = 1e4;

}  // namespace

std::optional<Times> FrameTimes::take(double now) {
  if (now - taken_ < kPeriodSeconds) return std::nullopt;
  taken_ = now;
  if (samples_[static_cast<std::size_t>(Place::kEncoder)].empty()) return std::nullopt;
  Times times;
  times.queuedTenthsOfMilliseconds = takeMedian(Place::kQueue);
  times.drawnTenthsOfMilliseconds = takeMedian(Place::kDrawing);
  times.encodedTenthsOfMilliseconds = takeMedian(Place::kEncoder);
  times.socketTenthsOfMilliseconds = takeMedian(Place::kSocket);
  times.lineTenthsOfMilliseconds = takeMedian(Place::kLine);
  return times;
}

std::uint16_t FrameTimes::takeMedian(Place place) {
  std::vector<double>& samples = samples_[static_cast<std::size_t>(place)];
  if (samples.empty()) return 0;
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::ranges::nth_element(samples, middle);
  const double median = *middle;
  samples.clear();
  return saturate<std::uint16_t>(std::lround(median * kTenthsOfMilliseconds));
}

}  // namespace grove::stream
