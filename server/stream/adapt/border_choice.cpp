#include "stream/adapt/border_choice.h"

#include <algorithm>

namespace grove::stream {
namespace {

constexpr double kHysteresis = 0.3;
/// Seconds: below the first, late look has nothing to hide; from the second on it gets the full border.
constexpr double kShortRoundTrip = 0.030;
constexpr double kLongRoundTrip = 0.100;

}  // namespace

void BorderChoice::update(bool hasRoom, double roundTrip) {
  if (!hasRoom) {
    steps_ = 0;
    return;
  }
  const double share = (roundTrip - kShortRoundTrip) / (kLongRoundTrip - kShortRoundTrip);
  const double steps = kSteps * std::clamp(share, 0.0, 1.0);
  if (steps >= steps_ + 1 || steps < steps_ - kHysteresis) steps_ = static_cast<int>(steps);
}

}  // namespace grove::stream
