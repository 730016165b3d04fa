#include "stream/adapt/shortage.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace grove::stream {
namespace {

/// Time in which the weight of the past falls to a third.
constexpr double kFadeSeconds = 1.5;
/// Frames that wait for a smaller share of the time count as punctual.
constexpr double kShareThatMatters = 0.15;
constexpr double kPeriodCalming = 0.1;
/// Longer periods are pauses in which no frame was wanted.
constexpr double kMaxPeriod = 1.0;

std::size_t index(LimitedBy who) { return static_cast<std::size_t>(who); }

}  // namespace

void Shortage::settle(double now) {
  const double passed = std::max(0.0, now - std::exchange(settled_, now));
  const double fade = std::exp(-passed / kFadeSeconds);
  for (double& each : seconds_) each *= fade;
  if (!isWaiting_) return;
  seconds_[index(waitsFor_)] += kFadeSeconds * (1.0 - fade);
  if (waitsFor_ == LimitedBy::kMachine) waitsForServer_ += passed;
}

void Shortage::blocked(LimitedBy who, double now) {
  settle(now);
  isWaiting_ = true;
  waitsFor_ = who;
}

double Shortage::began(double now) {
  settle(now);
  isWaiting_ = false;
  const double period = now - std::exchange(lastBegan_, now);
  if (period > 0.0 && period < kMaxPeriod) {
    period_ = period_ > 0.0 ? period_ + kPeriodCalming * (period - period_) : period;
  }
  return std::exchange(waitsForServer_, 0.0);
}

double Shortage::share(LimitedBy who, double now) const {
  const double fade = std::exp(-std::max(0.0, now - settled_) / kFadeSeconds);
  const double more = isWaiting_ && waitsFor_ == who ? 1.0 - fade : 0.0;
  return seconds_[index(who)] / kFadeSeconds * fade + more;
}

LimitedBy Shortage::main(double now) const {
  LimitedBy most = LimitedBy::kNothing;
  double largest = kShareThatMatters;
  for (const LimitedBy who : {LimitedBy::kLine, LimitedBy::kMachine, LimitedBy::kBrowser}) {
    if (const double share = this->share(who, now); share > largest) {
      largest = share;
      most = who;
    }
  }
  return most;
}

}  // namespace grove::stream
